#include "shoal/core/left_out.hpp"
#include "shoal/formations/selection.hpp"

namespace shoal::formations {
namespace {

const RegisterLeftOut<Selection> registered{"SHOAL_CGAL", {"delaunay"}};

}  // namespace
}  // namespace shoal::formations
