#include "shoal/scenarios/energy.hpp"

namespace shoal::scenarios {

void Energy::declare(Options<Energy>& o) {
  o.number("power_w", &Energy::power_w, "W", at_least(0),
           "electrical propulsion power at power_speed_m_s (Rypkema 2015, Table 4.1)");
  o.number("power_speed_m_s", &Energy::power_speed_m_s, "m/s", above(0),
           "speed through water at which power_w is drawn");
  o.word("law", &Energy::law, {{"cubic", Law::cubic}, {"constant", Law::constant}},
         "propulsion power grows with the cube of the speed (eq. 4.3), or is power_w whenever the "
         "vehicle moves (decaying_speed_ratio = false)");
  o.number("turning_power_w", &Energy::turning_power_w, "W", at_least(0),
           "drawn instead while the vehicle turns in place");
  o.number("turning_threshold", &Energy::turning_threshold, "", at_least(0),
           "heading thrust, as a share of the full one, above which the vehicle is turning");
  o.number("hotel_w", &Energy::hotel_w, "W", at_least(0), "hotel load (eq. 4.4)");
  o.number("ping_j", &Energy::ping_j, "J", at_least(0), "energy of one own ping");
  o.number("battery_wh", &Energy::battery_wh, "Wh", above(0),
           "energy pack; an empty one does not stop the vehicle, as in the test-bed");
}

}  // namespace shoal::scenarios
