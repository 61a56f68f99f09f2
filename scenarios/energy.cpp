#include "shoal/scenarios/energy.hpp"

namespace shoal::scenarios {

void Energy::Efficiency::declare(Options<Efficiency>& o) {
  using E = Efficiency;
  o.number("propeller", &E::propeller, "", in(1e-3, 1), "of the propeller");
  o.number("shaft", &E::shaft, "", in(1e-3, 1), "of its shaft");
  o.number("gear", &E::gear, "", in(1e-3, 1), "of the gears");
  o.number("motor", &E::motor, "", in(1e-3, 1), "of the motor");
}

void Energy::declare(Options<Energy>& o) {
  o.number("power_w", &Energy::power_w, "W", at_least(0),
           "electrical propulsion power at power_speed_m_s (Rypkema 2015, Table 4.1)");
  o.number("power_speed_m_s", &Energy::power_speed_m_s, "m/s", above(0),
           "speed through water at which power_w is drawn");
  o.word("law", &Energy::law,
         {{"vehicle", Law::vehicle},
          {"cubic", Law::cubic},
          {"constant", Law::constant},
          {"thrust", Law::thrust}},
         "propulsion power grows with the cube of the speed from power_w (eq. 4.3); is power_w "
         "whenever the vehicle moves (decaying_speed_ratio = false); follows from thrust and "
         "efficiency; or is the vehicle's own: cubic for `drifter`, thrust for `nps_auv`");
  o.table("efficiency", &Energy::efficiency,
          "shares of the electrical power that become thrust times speed, for law = \"thrust\" "
          "(Rypkema 2015, Table 4.1)");
  o.number("turning_power_w", &Energy::turning_power_w, "W", at_least(0),
           "drawn instead while the vehicle turns in place");
  o.number("turning_threshold", &Energy::turning_threshold, "", at_least(0),
           "heading thrust, as a share of the full one, above which the vehicle is turning");
  o.number("hotel_w", &Energy::hotel_w, "W", at_least(0), "hotel load (eq. 4.4)");
  o.number("ping_j", &Energy::ping_j, "J", at_least(0), "energy of one own ping");
  o.number("battery_wh", &Energy::battery_wh, "Wh", above(0), "energy pack");
  o.word("battery", &Energy::battery, {{"ignored", Battery::ignored}, {"limits", Battery::limits}},
         "an empty energy pack is only counted, as in the test-bed; or the vehicle stops: it "
         "drifts, neither pings nor listens, draws nothing, and stays in all measures");
}

}  // namespace shoal::scenarios
