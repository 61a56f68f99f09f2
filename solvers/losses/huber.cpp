#include "shoal/solvers/losses/huber.hpp"

namespace shoal::solvers {
namespace {

const Register<Loss, Huber> registered{"huber", "linear beyond a scale (Huber 1964)"};

}  // namespace
}  // namespace shoal::solvers
