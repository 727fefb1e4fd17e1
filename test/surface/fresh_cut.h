// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

// The library's own code keeps neither to -Wconversion nor to -Wpedantic.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wpedantic"
#include <maxflow/graph.h>
#pragma GCC diagnostic pop

namespace plumb::test {

// A minimum cut from nothing by Boykov's and Kolmogorov's own library: the truth that DynamicCut
// is held against.
class FreshCut {
 public:
  explicit FreshCut(std::size_t num_nodes)
      : graph_(static_cast<int>(num_nodes), static_cast<int>(2 * num_nodes)) {
    if (num_nodes > 0) graph_.add_node(static_cast<int>(num_nodes));
  }

  void SetTerminal(int node, int source_minus_sink) {
    graph_.add_tweights(node,
                        source_minus_sink > 0 ? source_minus_sink : 0,
                        source_minus_sink < 0 ? -source_minus_sink : 0);
  }
  void AddEdge(int a, int b, int capacity) { graph_.add_edge(a, b, capacity, capacity); }
  void Solve() { flow_ = graph_.maxflow(); }

  std::int64_t flow() const { return flow_; }

  // In the cut with the fewest nodes at the source.
  bool IsAtSource(int node) const {
    return graph_.what_segment(node, Graph::SINK) == Graph::SOURCE;
  }

 private:
  using Graph = maxflow::Graph<int, int, int>;

  Graph graph_;
  std::int64_t flow_ = 0;
};

}  // namespace plumb::test
