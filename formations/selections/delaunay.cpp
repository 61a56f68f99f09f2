#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include "shoal/formations/selection.hpp"

namespace shoal::formations {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
// The flag: a neighbour of the vehicle, or the vehicle.
using Vertex = CGAL::Triangulation_vertex_base_with_info_2<bool, Kernel>;
using Triangulation =
    CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<Vertex>>;

/// The neighbours of the vehicle in the Delaunay triangulation of all positions.
///
/// Of points on one line these are the next on either side. Neighbours on top of one another, or of
/// the vehicle, share a vertex and are chosen together. Predicates are exact: no position is too
/// flat or too close.
struct Delaunay final : Selection {
  void select(std::span<const Neighbour> in_range, std::vector<int>& chosen) const override {
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

  static void declare(Options<Delaunay>&) {}
};

const Register<Selection, Delaunay> registered{"delaunay",
                                               "neighbours in the Delaunay triangulation (CGAL)"};

}  // namespace
}  // namespace shoal::formations
