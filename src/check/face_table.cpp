// Check: the faces of all tetrahedra, grouped by their three vertices.
#include "check/face_table.h"

#include <algorithm>
#include <utility>

namespace holdfast::checking {

bool sort_corners(Triangle& face) {
  bool odd = false;
  const auto order = [&](std::size_t i, std::size_t j) {
    if (face[i] <= face[j]) return;
    std::swap(face[i], face[j]);
    odd = !odd;
  };
  order(0, 1);
  order(1, 2);
  order(0, 1);
  return odd;
}

FaceTable::FaceTable(std::span<const Tetrahedron> tetrahedra, std::size_t vertex_count, Pulse& pulse)
    : start_(vertex_count + 1, 0), half_faces_(4 * tetrahedra.size()) {
  for (const Tetrahedron& tetrahedron : tetrahedra) {
    pulse();
    for (unsigned side = 0; side < 4; ++side) {
      const auto corners = side_of(tetrahedron, side);
      ++start_[*std::min_element(corners.begin(), corners.end()) + 1];
    }
  }
  for (std::size_t vertex = 0; vertex < vertex_count; ++vertex) start_[vertex + 1] += start_[vertex];

  std::vector<std::size_t> next(start_.begin(), start_.end() - 1);
  for (std::size_t t = 0; t < tetrahedra.size(); ++t) {
    pulse();
    for (unsigned side = 0; side < 4; ++side) {
      Triangle face = side_of(tetrahedra[t], side);
      const bool odd = sort_corners(face);
      const auto code = static_cast<std::uint32_t>(8 * t + 2 * side + (odd ? 1U : 0U));
      half_faces_[next[face[0]]++] = {face[1], face[2], code};
    }
  }

  const auto earlier = [](const HalfFace& x, const HalfFace& y) {
    if (x.middle != y.middle) return x.middle < y.middle;
    return x.largest != y.largest ? x.largest < y.largest : x.code < y.code;
  };
  for (std::size_t vertex = 0; vertex < vertex_count; ++vertex) {
    pulse();
    std::sort(half_faces_.begin() + static_cast<std::ptrdiff_t>(start_[vertex]),
              half_faces_.begin() + static_cast<std::ptrdiff_t>(start_[vertex + 1]), earlier);
  }
}

std::size_t FaceTable::find(Triangle face) const {
  sort_corners(face);
  if (std::size_t{face[0]} + 1 >= start_.size()) return none;
  const std::pair key(face[1], face[2]);
  const auto begin = half_faces_.begin() + static_cast<std::ptrdiff_t>(start_[face[0]]);
  const auto end = half_faces_.begin() + static_cast<std::ptrdiff_t>(start_[face[0] + 1]);
  const auto place = std::partition_point(
      begin, end, [&](const HalfFace& half) { return std::pair(half.middle, half.largest) < key; });
  if (place == end || place->middle != face[1] || place->largest != face[2]) return none;
  return static_cast<std::size_t>(place - half_faces_.begin());
}

std::span<const HalfFace> FaceTable::group(std::size_t begin) const {
  // The list of the next vertex may begin with an equal pair, so the end of this list is needed.
  const auto bound = std::upper_bound(start_.begin(), start_.end(), begin);
  return std::span<const HalfFace>(half_faces_).subspan(begin, group_end(begin, *bound) - begin);
}

std::size_t FaceTable::group_end(std::size_t begin, std::size_t limit) const {
  std::size_t end = begin + 1;
  while (end < limit && half_faces_[end].middle == half_faces_[begin].middle &&
         half_faces_[end].largest == half_faces_[begin].largest)
    ++end;
  return end;
}

}  // namespace holdfast::checking
