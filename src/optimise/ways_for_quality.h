// The ways to remove a bad element, from the cheapest to the most expensive (paper §6.4), for meshes judged
// by Q.
#pragma once

#include <cstddef>
#include <random>
#include <vector>

#include "mesh/tet_mesh.h"
#include "optimise/agenda.h"
#include "optimise/badness.h"
#include "optimise/budget.h"
#include "optimise/exchange_for_quality.h"
#include "optimise/optimise.h"
#include "optimise/qualities.h"
#include "optimise/remove_flat.h"

namespace holdfast {

class Ways {
 public:
  Ways(TetMesh& mesh, Qualities& qualities, Vertex first_free, const BadFrom& bad_from, std::uint64_t seed)
      : mesh_(mesh),
        first_free_(first_free),
        bad_from_(bad_from),
        exchanger_(mesh, qualities, bad_from),
        flat_remover_(mesh),
        random_(seed) {}

  /// Whether elements may get points: none, when the search is repeated, the null ones now, or all that are
  /// worth one.
  enum class Points { none, later, for_null, now };
  /// The inputs of the ways besides the element, and their results.
  struct Attempt {
    const WaitingElement& element;
    /// The worst Q that cannot be improved: improving better elements does not improve the mesh's worst.
    double worst_stuck;
    Points points;
    Budget& budget;
    std::vector<Tet>& changed;  ///< tetrahedra made or moved; some may be gone again
    Vertex added = kNone;       ///< the point that was added
  };
  /// The count of the cheapest way that helped; null if none has. Even then something may have changed.
  [[nodiscard]] std::size_t OptimiseStats::*try_all(Attempt& attempt);

  /// Moves p if its ball gets better. Balls of hundreds are left alone.
  bool move(Vertex p, Budget& budget, std::vector<Tet>& changed);

  [[nodiscard]] std::mt19937_64& random() { return random_; }
  /// These vertices do not move, and their surroundings must not be read while threads change parts of the
  /// mesh (mesh/in_place_parts.h).
  void hold(const std::vector<std::uint8_t>& held) { held_ = &held; }
  /// Points are put at these vertices, which are in no tetrahedron, as long as there are any: threads that
  /// change parts of the mesh cannot add vertices.
  void take_points_from(std::vector<Vertex>& spare) { spare_ = &spare; }
  /// The vertices from here on may be moved and removed.
  [[nodiscard]] Vertex first_free() const { return first_free_; }

 private:
  struct Way;
  bool exchange(Attempt& attempt);
  bool move_a_corner(Attempt& attempt);
  bool remove_flat(Attempt& attempt);
  bool reconnect_round(Attempt& attempt);
  bool reconnect_patiently(Attempt& attempt);
  bool insert(Attempt& attempt);
  [[nodiscard]] bool may_get_a_point(const Attempt& attempt) const;
  [[nodiscard]] bool is_worth_a_point(const Attempt& attempt) const;
  [[nodiscard]] bool is_worth_reconnecting(const Attempt& attempt) const;

  TetMesh& mesh_;
  const Vertex first_free_;
  const std::vector<std::uint8_t>* held_ = nullptr;
  std::vector<Vertex>* spare_ = nullptr;
  const BadFrom& bad_from_;
  Exchanger exchanger_;
  FlatRemover flat_remover_;
  std::mt19937_64 random_;
  int reconnections_in_vain_ = 0, patient_ = 0;
};

}  // namespace holdfast
