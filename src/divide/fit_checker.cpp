// Whether parts fit. Each part is known to be a valid mesh of its own surface, so only the faces on the
// boundaries must be checked: the boundary of all parts together is that of the given surface, with each face
// once.
#include <algorithm>
#include <string>

#include "divide/numbered_places.h"
#include "holdfast/divide.h"
#include "mesh/anatomy.h"
#include "surface/describe.h"
#include "text/count.h"

namespace holdfast {
namespace {

/// A face on the boundary of a part.
struct Outer {
  Triangle places;  ///< in ascending order
  bool is_odd;      ///< of the turn that `corners_of_face` has
  std::uint32_t part;
  int region;
};

bool is_odd(const Triangle& t) {
  const int descents = (t[0] > t[1] ? 1 : 0) + (t[1] > t[2] ? 1 : 0) + (t[0] > t[2] ? 1 : 0);
  return descents % 2 == 1;
}

}  // namespace

struct FitChecker::State {
  State(const Complex& complex, bool dropped) : places(complex), outside_dropped(dropped), seen(places) {}

  void see_boundary(const Volume& part) {
    const std::vector<Neighbours> beside = neighbours(part.tetrahedra);
    for (std::size_t t = 0; t < beside.size(); ++t)
      for (std::size_t k = 0; k < 4; ++k) {
        if (beside[t][k] != no_entity) continue;
        Triangle corners = corners_of_face(part.tetrahedra[t], static_cast<int>(k));
        for (Index& v : corners) v = places.welder.add(part.vertices[v]);
        outer.push_back(
            {ascending(corners), is_odd(corners), parts, part.regions.empty() ? 0 : part.regions[t]});
      }
  }

  [[nodiscard]] std::string words(const Outer& face) const {
    std::string text = "the face of part " + std::to_string(face.part) + " with the corners";
    for (const Index v : face.places) text += " " + place(places.points[v]);
    return text;
  }

  [[nodiscard]] Fit fit_of(FitKind kind, const std::vector<bool>& seen, const char* one,
                           const char* many) const {
    const auto missing = static_cast<std::size_t>(std::count(seen.begin(), seen.end(), false));
    const std::string all = std::to_string(seen.size()) + " " + (seen.size() == 1 ? one : many);
    if (missing == 0) return {kind, true, all};
    if (outside_dropped) return {kind, true, all + ", " + std::to_string(missing) + " dropped"};
    const auto first = static_cast<std::size_t>(std::find(seen.begin(), seen.end(), false) - seen.begin());
    return {kind, false,
            std::to_string(missing) + " of " + all + (missing == 1 ? " is" : " are") +
                " in no part, such as " + one + " " + std::to_string(first)};
  }

  division::SurfacePlaces places;
  bool outside_dropped;
  division::Seen seen;
  std::vector<Outer> outer;
  std::uint32_t parts = 0;
};

FitChecker::FitChecker(const Complex& surface, bool outside_dropped)
    : state_(std::make_unique<State>(surface, outside_dropped)) {}
FitChecker::~FitChecker() = default;
FitChecker::FitChecker(FitChecker&&) noexcept = default;
FitChecker& FitChecker::operator=(FitChecker&&) noexcept = default;

void FitChecker::add(const Volume& part) {
  state_->seen.add(part, state_->places);
  state_->see_boundary(part);
  ++state_->parts;
}

std::vector<Fit> FitChecker::finish() const {
  const State& s = *state_;
  std::vector<Outer> faces = s.outer;
  std::sort(faces.begin(), faces.end(), [](const Outer& a, const Outer& b) {
    return a.places != b.places ? a.places < b.places : a.part < b.part;
  });
  std::size_t matched = 0, unmatched = 0, twice = 0;
  std::string first_unmatched, first_twice;
  for (std::size_t i = 0, end = 0; i < faces.size(); i = end) {
    end = i + 1;
    while (end < faces.size() && faces[end].places == faces[i].places) ++end;
    const bool is_facet = s.places.facets.find(faces[i].places) != no_entity;
    if (end - i == 1) {
      if (is_facet || unmatched++ > 0) continue;
      first_unmatched = s.words(faces[i]) + " is neither the surface's nor another part's";
    } else if (end - i == 2 && faces[i].is_odd != faces[i + 1].is_odd) {
      if (is_facet || faces[i].region == faces[i + 1].region)
        ++matched;
      else if (unmatched++ == 0)
        first_unmatched = s.words(faces[i]) + " is no facet, and has region " +
                          std::to_string(faces[i].region) + " there, but " +
                          std::to_string(faces[i + 1].region) + " in part " +
                          std::to_string(faces[i + 1].part);
    } else if (twice++ == 0) {
      first_twice = s.words(faces[i]) + " is also one of part " + std::to_string(faces[i + 1].part);
    }
  }
  return {s.fit_of(FitKind::facets_there, s.seen.facets, "facet", "facets"),
          s.fit_of(FitKind::segments_there, s.seen.segments, "segment", "segments"),
          s.fit_of(FitKind::vertices_there, s.seen.vertices, "vertex", "vertices"),
          {FitKind::interfaces_matched, unmatched == 0,
           unmatched == 0 ? counted(matched, "face") + " between parts"
                          : counted(unmatched, "face") + " unmatched: " + first_unmatched},
          {FitKind::nothing_twice, twice == 0,
           twice == 0 ? ""
                      : counted(twice, "face has", "faces have") + " two parts on one side: " + first_twice}};
}

}  // namespace holdfast
