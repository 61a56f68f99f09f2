#include "shoal/core/left_out.hpp"
#include "shoal/formations/potential.hpp"

namespace shoal::formations {
namespace {

const RegisterLeftOut<Potential> registered{"SHOAL_GINAC", {"expression"}};

}  // namespace
}  // namespace shoal::formations
