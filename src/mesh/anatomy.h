// Anatomy of a tetrahedron: the one numbering of vertices, faces and edges that everything derives from.
//
//            3                 A tetrahedron (v0 v1 v2 v3) is positive: det(v1-v0, v2-v0, v3-v0) > 0.
//           /|\                Face i is opposite vertex i; its three vertices are listed so that
//          / | \               (f0 f1 f2 vi) is again positive, that is, seen from outside they turn
//         /  |  \              clockwise.
//        0---|---2             A face is named by the code 4*tet + i; the neighbour stored for it is
//         \  |  /              the code of the same face in the tetrahedron on the other side.
//          \ | /               Edges 0..5 are 01 02 03 12 13 23; edge k and edge 5-k are opposite.
//            1
//
// Flags of a tetrahedron (16 bits):
//   bits 0..3   face i lies in an input facet
//   bits 4..9   edge k lies in an input segment (a facet's side or a dangling segment)
//   bit  10     visited: scratch of a traversal, zero outside it
//   bit  11     dead: the slot is free
//   bits 12..15 scratch of one stage, zero outside it
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace holdfast {

using Vertex = std::uint32_t;
using Tet = std::uint32_t;
using Face = std::uint32_t;  ///< 4 * tetrahedron + local face
using Flags = std::uint16_t;

inline constexpr std::uint32_t kNone = 0xFFFFFFFFu;
/// The vertex at infinity: a ghost tetrahedron joins it to a face of the hull, always in slot 3.
inline constexpr Vertex kGhost = 0xFFFFFFFEu;

inline constexpr Tet tet_of(Face f) { return f >> 2; }
inline constexpr int side_of(Face f) { return static_cast<int>(f & 3u); }
inline constexpr Face face_code(Tet t, int i) { return 4 * t + static_cast<Face>(i); }

/// Vertices of face i, in the order that makes (f0 f1 f2 vi) an even permutation of (v0 v1 v2 v3).
inline constexpr std::array<std::array<int, 3>, 4> kFaceVertex{{{1, 3, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 2}}};

/// Ends of edge k.
inline constexpr std::array<std::array<int, 2>, 6> kEdgeVertex{
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

/// Edge between two local vertices.
inline constexpr std::array<std::array<int, 4>, 4> kEdgeOf{
    {{-1, 0, 1, 2}, {0, -1, 3, 4}, {1, 3, -1, 5}, {2, 4, 5, -1}}};

inline constexpr int edge_between(int i, int j) {
  return kEdgeOf[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
}

/// The position of a vertex among four distinct ones, or -1. Without branches, because the position is random
/// and every other branch would be mispredicted.
inline constexpr int index_among(const std::array<Vertex, 4>& corners, Vertex v) {
  return static_cast<int>(corners[0] == v) + 2 * static_cast<int>(corners[1] == v) +
         3 * static_cast<int>(corners[2] == v) + 4 * static_cast<int>(corners[3] == v) - 1;
}

/// The entries of an array, one a corner, at the corners of face i, and at the ends of edge k.
template <typename T>
constexpr std::array<T, 3> corners_of_face(const std::array<T, 4>& at, int i) {
  const auto& k = kFaceVertex[static_cast<std::size_t>(i)];
  return {at[static_cast<std::size_t>(k[0])], at[static_cast<std::size_t>(k[1])],
          at[static_cast<std::size_t>(k[2])]};
}
template <typename T>
constexpr std::array<T, 2> ends_of_edge(const std::array<T, 4>& at, int k) {
  const auto& e = kEdgeVertex[static_cast<std::size_t>(k)];
  return {at[static_cast<std::size_t>(e[0])], at[static_cast<std::size_t>(e[1])]};
}

/// For local vertices a != b, the other two, ordered so that (a b c d) is an even permutation.
inline constexpr std::array<std::array<std::array<int, 2>, 4>, 4> kOpposite{{
    {{{-1, -1}, {2, 3}, {3, 1}, {1, 2}}},
    {{{3, 2}, {-1, -1}, {0, 3}, {2, 0}}},
    {{{1, 3}, {3, 0}, {-1, -1}, {0, 1}}},
    {{{2, 1}, {0, 2}, {1, 0}, {-1, -1}}},
}};

inline constexpr const std::array<int, 2>& opposite_corners(int a, int b) {
  return kOpposite[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)];
}

inline constexpr Flags facet_bit(int face) { return static_cast<Flags>(1u << face); }
inline constexpr Flags segment_bit(int edge) { return static_cast<Flags>(1u << (4 + edge)); }
inline constexpr Flags kFacetBits = 0x000F;
inline constexpr Flags kSegmentBits = 0x03F0;
inline constexpr Flags kVisited = 0x0400;
inline constexpr Flags kDead = 0x0800;

}  // namespace holdfast
