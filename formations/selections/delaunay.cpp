#include "shoal/formations/selections/delaunay.hpp"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

namespace shoal::formations {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
// The flag: a neighbour of the vehicle, or the vehicle.
using Vertex = CGAL::Triangulation_vertex_base_with_info_2<bool, Kernel>;
using Triangulation =
    CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<Vertex>>;

const Register<Selection, Delaunay> registered{"delaunay",
                                               "neighbours in the Delaunay triangulation (CGAL)"};

}  // namespace

void Delaunay::select(std::span<const Neighbour> in_range, std::vector<int>& chosen) const {
  Triangulation triangulation;
  const auto inserted = [&](const Eigen::Vector2d& p) {
    const auto vertex = triangulation.insert({p.x(), p.y()});
    vertex->info() = false;
    return vertex;
  };
  const auto own = inserted(Eigen::Vector2d::Zero());
  thread_local std::vector<Triangulation::Vertex_handle> vertices;
  vertices.clear();
  for (const Neighbour& n : in_range) vertices.push_back(inserted(n.position));

  own->info() = true;
  if (triangulation.dimension() > 0) {
    const auto first = triangulation.incident_vertices(own);
    auto vertex = first;
    do {
      if (!triangulation.is_infinite(vertex)) vertex->info() = true;
    } while (++vertex != first);
  }
  chosen.clear();
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (vertices[i]->info()) chosen.push_back(static_cast<int>(i));
  }
}

}  // namespace shoal::formations
