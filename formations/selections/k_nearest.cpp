#include "shoal/formations/selections/k_nearest.hpp"

namespace shoal::formations {
namespace {

const Register<Selection, KNearest> registered{"k_nearest", "the k nearest neighbours"};

}  // namespace
}  // namespace shoal::formations
