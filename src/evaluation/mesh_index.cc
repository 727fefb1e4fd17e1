// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <cmath>
#include <memory>
#include <stdexcept>

#include "common/embree_handle.h"
#include "plumbline/evaluation/nearest.h"

namespace plumb {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

// Embree: with the tree of CGAL, evaluating a flight took ten times as long. In float: to a
// hundredth of a millimetre within 100 m.
class Obstacles {
 public:
  explicit Obstacles(const Triangles& triangles)
      : device_(internal::StartEmbree("set_affinity=0")), scene_(rtcNewScene(device_.get())) {
    const internal::EmbreeTriangles all =
        internal::NewTriangles(device_, 3 * triangles.size(), triangles.size());
    float* coordinate = all.vertices;
    for (unsigned corner = 0; corner < 3 * triangles.size(); ++corner) {
      const Kernel::Point_3 point = triangles[corner / 3].vertex(static_cast<int>(corner % 3));
      for (int axis = 0; axis < 3; ++axis) *coordinate++ = static_cast<float>(point[axis]);
      all.indices[corner] = corner;
    }
    rtcCommitGeometry(all.geometry.get());
    rtcAttachGeometry(scene_.get(), all.geometry.get());
    rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);  // No ray slips through an edge.
    rtcCommitScene(scene_.get());
  }

  bool AreBetween(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const {
    const Eigen::Vector3f origin = from.cast<float>();
    const Eigen::Vector3f way = (to - from).cast<float>();
    RTCRay ray{};
    ray.org_x = origin.x();
    ray.org_y = origin.y();
    ray.org_z = origin.z();
    ray.dir_x = way.x();
    ray.dir_y = way.y();
    ray.dir_z = way.z();
    ray.tfar = 1.0F;
    ray.mask = ~0U;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(scene_.get(), &context, &ray);
    return ray.tfar < 0.0F;
  }

 private:
  internal::EmbreeDevice device_;
  internal::EmbreeScene scene_;
};

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
    obstacles_ = std::make_unique<const Obstacles>(triangles_);
  }

  NearestOnMesh NearestTo(const Eigen::Vector3d& point) const {
    const Kernel::Point_3 query = ToCgal(point);
    const auto [nearest, triangle] = tree_.closest_point_and_primitive(query);
    const auto kept_idx = static_cast<std::size_t>(triangle - triangles_.cbegin());
    return {std::sqrt(CGAL::squared_distance(query, nearest)), triangle_idx_[kept_idx]};
  }

  bool Blocks(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const {
    return obstacles_->AreBetween(from, to);
  }

 private:
  Triangles triangles_;
  std::vector<std::uint32_t> triangle_idx_;  // In the mesh, of each that is kept.
  Tree tree_;
  std::unique_ptr<const Obstacles> obstacles_;
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
