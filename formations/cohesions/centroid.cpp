#include "shoal/formations/cohesions/centroid.hpp"

namespace shoal::formations {
namespace {

const Register<Cohesion, TowardsCentroid> registered{
    "centroid", "pull towards the centroid of all neighbours in range (Rypkema 2015, eq. 3.7)"};

}  // namespace
}  // namespace shoal::formations
