#include "shoal/formations/selections/in_range.hpp"

namespace shoal::formations {
namespace {

const Register<Selection, InRange> registered{"in_range",
                                              "all neighbours in range (Rypkema 2015, eq. 3.5)"};

}  // namespace
}  // namespace shoal::formations
