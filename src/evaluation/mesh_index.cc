// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <cmath>
#include <stdexcept>

#include "plumbline/evaluation/nearest.h"

namespace plumb {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

Kernel::Point_3 ToCgal(const Eigen::Vector3d& point) { return {point.x(), point.y(), point.z()}; }

}  // namespace

class MeshIndex::Impl {
 public:
  explicit Impl(const TriangleMesh& mesh) {
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      if (!(TriangleArea(mesh, i) > 0.0)) continue;
      const auto& corner = mesh.triangles[i];
      triangles_.emplace_back(ToCgal(mesh.vertices[corner[0]]),
                              ToCgal(mesh.vertices[corner[1]]),
                              ToCgal(mesh.vertices[corner[2]]));
      triangle_idx_.push_back(static_cast<std::uint32_t>(i));
    }
    if (triangles_.empty()) throw std::invalid_argument("the mesh has no area");
    tree_.insert(triangles_.cbegin(), triangles_.cend());
    tree_.build();
    tree_.accelerate_distance_queries();
  }

  NearestOnMesh NearestTo(const Eigen::Vector3d& point) const {
    const Kernel::Point_3 query = ToCgal(point);
    const auto [nearest, triangle] = tree_.closest_point_and_primitive(query);
    const auto kept_idx = static_cast<std::size_t>(triangle - triangles_.cbegin());
    return {std::sqrt(CGAL::squared_distance(query, nearest)), triangle_idx_[kept_idx]};
  }

  bool Blocks(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const {
    return tree_.do_intersect(Kernel::Segment_3(ToCgal(from), ToCgal(to)));
  }

 private:
  Triangles triangles_;
  std::vector<std::uint32_t> triangle_idx_;  // In the mesh, of each that is kept.
  Tree tree_;
};

MeshIndex::MeshIndex(const TriangleMesh& mesh) : impl_(std::make_unique<Impl>(mesh)) {}
MeshIndex::~MeshIndex() = default;

NearestOnMesh MeshIndex::NearestTo(const Eigen::Vector3d& point) const {
  return impl_->NearestTo(point);
}

bool MeshIndex::Blocks(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const {
  return impl_->Blocks(from, to);
}

}  // namespace plumb
