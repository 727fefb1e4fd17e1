// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "matching/neighbor_search.h"

#include <algorithm>
#include <thread>

#include "matching/packed_descriptors.h"
#include "plumbline/common/check.h"

namespace plumb::internal {
namespace {

constexpr std::int32_t kNoKey = std::numeric_limits<std::int32_t>::max();
constexpr int kMaxIndices = 1 << kKeyIndexBits;
// A multiple of every kernel's tile_rows, as large as the key's index allows.
constexpr int kBlockRows = 252;

std::int32_t Term(std::int32_t squared_norm, int index) {
  if (squared_norm == PackedDescriptors::kPaddingNorm2) return kNoKey;
  return squared_norm * kMaxIndices + index;
}

// Takes a candidate into the two nearest of a row.
void Insert(std::int32_t idx, std::int32_t distance2, RowNeighbors* row) {
  if (distance2 < row->best_distance2 ||
      (distance2 == row->best_distance2 && idx < row->best_idx)) {
    row->second_distance2 = row->best_distance2;
    row->best_distance2 = distance2;
    row->best_idx = idx;
  } else {
    row->second_distance2 = std::min(row->second_distance2, distance2);
  }
}

// Searches a range of whole row blocks; one object a thread.
class BlockSearch {
 public:
  BlockSearch(const TileKernel& kernel,
              const PackedDescriptors& rows,
              const PackedDescriptors& columns,
              std::vector<RowNeighbors>* row_neighbors)
      : kernel_(kernel),
        rows_(rows),
        columns_(columns),
        row_neighbors_(*row_neighbors),
        row_terms_(kBlockRows, kNoKey),
        column_terms_(static_cast<std::size_t>(columns.num_padded()), kNoKey),
        row_best_(static_cast<std::size_t>(kBlockRows * kernel.lanes), kNoKey),
        row_second_(static_cast<std::size_t>(kBlockRows * kernel.lanes), kNoKey),
        tile_column_best_(static_cast<std::size_t>(kernel.tile_vectors * kernel.lanes), kNoKey),
        column_values_(static_cast<std::size_t>(columns.num_padded()), kNoKey),
        column_rows_(static_cast<std::size_t>(columns.num_padded()), kNoNeighbor),
        panel_columns_(kMaxIndices / kernel.tile_vectors * kernel.tile_vectors * kernel.lanes) {
    for (int j = 0; j < columns.num_padded(); ++j) {
      const int group_in_panel = j % panel_columns_ / kernel.lanes;
      column_terms_.data()[j] =
          Term(columns.squared_norms()[static_cast<std::size_t>(j)], group_in_panel);
    }
  }

  void SearchBlock(int begin) {
    const int end = std::min(begin + kBlockRows, rows_.num_padded());
    for (int i = begin; i < end; ++i) {
      row_terms_.data()[i - begin] =
          Term(rows_.squared_norms()[static_cast<std::size_t>(i)], i - begin);
    }
    for (int panel = 0; panel < columns_.num_padded(); panel += panel_columns_) {
      SearchPanel(begin, end, panel);
      TakeRows(begin, end, panel);
    }
  }

  // Smallest |a|^2 - 2 a.b by column, and the row it belongs to.
  const std::vector<std::int32_t>& column_values() const { return column_values_; }
  const std::vector<std::int32_t>& column_rows() const { return column_rows_; }

 private:
  void SearchPanel(int begin, int end, int panel) {
    std::fill_n(row_best_.data(), kBlockRows * kernel_.lanes, kNoKey);
    std::fill_n(row_second_.data(), kBlockRows * kernel_.lanes, kNoKey);
    const int tile_columns = kernel_.tile_vectors * kernel_.lanes;
    const int panel_end = std::min(panel + panel_columns_, columns_.num_padded());
    for (int column = panel; column < panel_end; column += tile_columns) {
      std::fill_n(tile_column_best_.data(), tile_columns, kNoKey);
      for (int row = begin; row < end; row += kernel_.tile_rows) RunTile(begin, row, column);
      TakeColumns(begin, column);
    }
  }

  void RunTile(int block_begin, int row, int column) {
    const int in_block = row - block_begin;
    TileJob job;
    job.rows = rows_.Tile(row);
    job.columns = columns_.Tile(column);
    job.row_terms = row_terms_.data() + in_block;
    job.column_terms = column_terms_.data() + column;
    job.column_biases = columns_.biases() + column;
    job.row_best = row_best_.data() + in_block * kernel_.lanes;
    job.row_second = row_second_.data() + in_block * kernel_.lanes;
    job.column_best = tile_column_best_.data();
    kernel_.run(job);
  }

  void TakeColumns(int block_begin, int column) {
    for (int j = 0; j < kernel_.tile_vectors * kernel_.lanes; ++j) {
      const std::int32_t key = tile_column_best_.data()[j];
      const auto target = static_cast<std::size_t>(column + j);
      if (key == kNoKey || (key >> kKeyIndexBits) >= column_values_[target]) continue;
      column_values_[target] = key >> kKeyIndexBits;
      column_rows_[target] = block_begin + (key & (kMaxIndices - 1));
    }
  }

  void TakeRows(int begin, int end, int panel) {
    const int num_rows = static_cast<int>(row_neighbors_.size());
    for (int i = begin; i < std::min(end, num_rows); ++i) {
      const auto row = static_cast<std::size_t>(i);
      const std::int32_t squared_norm = rows_.squared_norms()[row];
      const std::int32_t* best = row_best_.data() + (i - begin) * kernel_.lanes;
      const std::int32_t* second = row_second_.data() + (i - begin) * kernel_.lanes;
      for (int lane = 0; lane < kernel_.lanes; ++lane) {
        for (std::int32_t key : {best[lane], second[lane]}) {
          if (key == kNoKey) continue;
          const int idx = panel + (key & (kMaxIndices - 1)) * kernel_.lanes + lane;
          Insert(idx, (key >> kKeyIndexBits) + squared_norm, &row_neighbors_[row]);
        }
      }
    }
  }

  const TileKernel& kernel_;
  const PackedDescriptors& rows_;
  const PackedDescriptors& columns_;
  std::vector<RowNeighbors>& row_neighbors_;
  AlignedArray<std::int32_t> row_terms_;
  AlignedArray<std::int32_t> column_terms_;
  AlignedArray<std::int32_t> row_best_;
  AlignedArray<std::int32_t> row_second_;
  AlignedArray<std::int32_t> tile_column_best_;
  std::vector<std::int32_t> column_values_;
  std::vector<std::int32_t> column_rows_;
  int panel_columns_;
};

// Searches all blocks, an equal share of consecutive ones in each thread.
void SearchBlocks(int num_blocks, std::vector<BlockSearch>* searches) {
  const int num_threads = static_cast<int>(searches->size());
  const auto search_share = [&](int thread) {
    const int end = num_blocks * (thread + 1) / num_threads;
    for (int block = num_blocks * thread / num_threads; block < end; ++block) {
      (*searches)[static_cast<std::size_t>(thread)].SearchBlock(block * kBlockRows);
    }
  };
  std::vector<std::thread> threads;
  for (int t = 1; t < num_threads; ++t) threads.emplace_back(search_share, t);
  search_share(0);
  for (std::thread& thread : threads) thread.join();
}

// Earlier searches hold smaller rows, so they keep equal distances.
std::vector<std::int32_t> MergeColumns(const std::vector<BlockSearch>& searches, int num_columns) {
  std::vector<std::int32_t> merged(static_cast<std::size_t>(num_columns), kNoNeighbor);
  for (std::size_t j = 0; j < merged.size(); ++j) {
    std::int32_t smallest = kNoKey;
    for (const BlockSearch& search : searches) {
      if (search.column_values()[j] >= smallest) continue;
      smallest = search.column_values()[j];
      merged[j] = search.column_rows()[j];
    }
  }
  return merged;
}

}  // namespace

Neighbors FindNeighbors(SimdPath path,
                        const DescriptorSpan& rows,
                        const DescriptorSpan& columns,
                        int num_threads) {
  PLUMB_CHECK_GE(num_threads, 1);
  Neighbors neighbors;
  neighbors.rows.resize(static_cast<std::size_t>(rows.count));
  neighbors.column_best_idx.assign(static_cast<std::size_t>(columns.count), kNoNeighbor);
  if (rows.count == 0 || columns.count == 0) return neighbors;

  const TileKernel& kernel = KernelOf(path);
  const PackedDescriptors packed_rows(kernel, PackedSide::kRows, rows);
  const PackedDescriptors packed_columns(kernel, PackedSide::kColumns, columns);
  const int num_blocks = (packed_rows.num_padded() + kBlockRows - 1) / kBlockRows;
  std::vector<BlockSearch> searches;
  for (int t = 0; t < std::min(num_threads, num_blocks); ++t) {
    searches.emplace_back(kernel, packed_rows, packed_columns, &neighbors.rows);
  }
  SearchBlocks(num_blocks, &searches);
  neighbors.column_best_idx = MergeColumns(searches, columns.count);
  return neighbors;
}

}  // namespace plumb::internal
