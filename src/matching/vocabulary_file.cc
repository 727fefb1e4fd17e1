// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstring>
#include <stdexcept>

#include "plumbline/common/atomic_file.h"
#include "plumbline/matching/vocabulary_tree.h"

namespace plumb {
namespace {

constexpr char kMagic[] = "PLUMBVOC";
constexpr std::size_t kMagicSize = sizeof(kMagic) - 1;
constexpr std::uint32_t kVersion = 1;
constexpr std::size_t kHeaderSize = kMagicSize + 3 * sizeof(std::uint32_t);
constexpr std::size_t kNodeSize = 2 * sizeof(std::uint32_t) + kDescriptorSize;
constexpr std::size_t kHashSize = sizeof(std::uint64_t);

[[noreturn]] void Fail(const std::string& path, const std::string& what) {
  throw std::runtime_error("vocabulary file " + path + ": " + what +
                           "; save the vocabulary again, or leave vocabulary_path empty to train "
                           "one on the session's own photos");
}

// Fowler, Noll & Vo, FNV-1a, 64 bits.
std::uint64_t Hash(const std::uint8_t* bytes, std::size_t size) {
  std::uint64_t hash = 14695981039346656037U;
  for (std::size_t i = 0; i < size; ++i) hash = (hash ^ bytes[i]) * 1099511628211U;
  return hash;
}

template <typename Integer>
void Append(Integer value, std::vector<std::uint8_t>* bytes) {
  for (std::size_t i = 0; i < sizeof(Integer); ++i) {
    bytes->push_back(static_cast<std::uint8_t>(value >> (8 * i)));
  }
}

template <typename Integer>
Integer Read(const std::uint8_t* bytes) {
  Integer value = 0;
  for (std::size_t i = 0; i < sizeof(Integer); ++i) {
    value |= static_cast<Integer>(static_cast<Integer>(bytes[i]) << (8 * i));
  }
  return value;
}

// The number of nodes, once the bytes are known to be whole.
std::uint32_t CheckFile(const std::string& path, const std::vector<std::uint8_t>& bytes) {
  if (bytes.size() < kMagicSize || std::memcmp(bytes.data(), kMagic, kMagicSize) != 0) {
    Fail(path, "is not a Plumbline vocabulary");
  }
  if (bytes.size() < kHeaderSize) Fail(path, "ends within its header");
  const auto version = Read<std::uint32_t>(bytes.data() + kMagicSize);
  if (version != kVersion) {
    Fail(path,
         "has version " + std::to_string(version) + ", this program reads version " +
             std::to_string(kVersion));
  }
  const auto descriptor_size = Read<std::uint32_t>(bytes.data() + kMagicSize + 4);
  if (descriptor_size != kDescriptorSize) {
    Fail(path, "is for descriptors of " + std::to_string(descriptor_size) + " bytes, not 128");
  }
  const auto num_nodes = Read<std::uint32_t>(bytes.data() + kMagicSize + 8);
  const std::size_t size = kHeaderSize + num_nodes * kNodeSize + kHashSize;
  if (num_nodes == 0 || bytes.size() != size) {
    Fail(path,
         "has " + std::to_string(bytes.size()) + " bytes, not the " + std::to_string(size) +
             " of its " + std::to_string(num_nodes) + " nodes");
  }
  const std::size_t hashed = size - kHashSize;
  if (Hash(bytes.data(), hashed) != Read<std::uint64_t>(bytes.data() + hashed)) {
    Fail(path, "is damaged (its checksum does not fit)");
  }
  return num_nodes;
}

}  // namespace

VocabularyTree VocabularyTree::Load(const std::string& path) {
  const std::vector<std::uint8_t> bytes = ReadFileBytes(path);
  VocabularyTree tree;
  tree.nodes_.resize(CheckFile(path, bytes));
  const std::uint8_t* next = bytes.data() + kHeaderSize;
  for (std::size_t i = 0; i < tree.nodes_.size(); ++i, next += kNodeSize) {
    Node& node = tree.nodes_[i];
    node.first_child = Read<std::uint32_t>(next);
    node.num_children = Read<std::uint32_t>(next + 4);
    std::memcpy(node.center.data(), next + 8, kDescriptorSize);
    const std::uint64_t end = std::uint64_t{node.first_child} + node.num_children;
    if (node.num_children > 0 && (node.first_child <= i || end > tree.nodes_.size())) {
      Fail(path, "is not a tree: the children of node " + std::to_string(i) + " are misplaced");
    }
  }
  tree.NumberWords();
  return tree;
}

void VocabularyTree::Save(const std::string& path) const {
  std::vector<std::uint8_t> bytes(kMagic, kMagic + kMagicSize);
  bytes.reserve(kHeaderSize + nodes_.size() * kNodeSize + kHashSize);
  Append(kVersion, &bytes);
  Append(static_cast<std::uint32_t>(kDescriptorSize), &bytes);
  Append(static_cast<std::uint32_t>(nodes_.size()), &bytes);
  for (const Node& node : nodes_) {
    Append(node.first_child, &bytes);
    Append(node.num_children, &bytes);
    bytes.insert(bytes.end(), node.center.begin(), node.center.end());
  }
  Append(Hash(bytes.data(), bytes.size()), &bytes);
  WriteFileAtomically(path, bytes.data(), bytes.size());
}

}  // namespace plumb
