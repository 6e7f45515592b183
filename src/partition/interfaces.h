// The faces between a piece and other pieces, in an order on which both sides agree.
#pragma once

#include <algorithm>
#include <map>
#include <vector>

#include "holdfast/partition.h"

namespace holdfast::partitions {

class InterfaceFaces {
 public:
  /// Adds a face of this piece by its vertices, counterclockwise from outside.
  void add(Index other, const Triangle& face) { faces_[other].push_back(face); }

  /// Orders the faces by `numbers`, the vertices' numbers in the whole mesh: each face begins with its least
  /// vertex.
  [[nodiscard]] std::vector<MeshPiece::Interface> take(const std::vector<std::uint64_t>& numbers) {
    const auto less = [&](Index a, Index b) { return numbers[a] < numbers[b]; };
    const auto key = [&](Triangle face) {
      std::sort(face.begin() + 1, face.end(), less);
      return std::array<std::uint64_t, 3>{numbers[face[0]], numbers[face[1]], numbers[face[2]]};
    };
    std::vector<MeshPiece::Interface> result;
    for (auto& [other, faces] : faces_) {
      for (Triangle& face : faces)
        std::rotate(face.begin(), std::min_element(face.begin(), face.end(), less), face.end());
      std::sort(faces.begin(), faces.end(),
                [&](const Triangle& a, const Triangle& b) { return key(a) < key(b); });
      result.push_back({other, std::move(faces)});
    }
    faces_.clear();
    return result;
  }

 private:
  std::map<Index, std::vector<Triangle>> faces_;
};

}  // namespace holdfast::partitions
