#include "shoal/formations/selections/two_neighbours.hpp"

namespace shoal::formations {
namespace {

const Register<Selection, TwoNeighbours> registered{
    "two_neighbours", "the nearest, and the one of the shortest triangle (Lee and Chong 2008)"};

}  // namespace
}  // namespace shoal::formations
