// Parts of a volume by METIS (Karypis and Kumar 1998): a graph whose vertices are the tetrahedra, and whose
// edges are the faces between them.
#include <algorithm>
#include <limits>
#include <mutex>
#include <stdexcept>
#include <string>

#include "holdfast/holdfast.h"
#include "holdfast/partition.h"
#include "numbers/float_environment.h"
#include "text/count.h"

#ifdef HOLDFAST_METIS
#include <metis.h>
#endif

namespace holdfast {

#ifdef HOLDFAST_METIS
namespace {

constexpr idx_t kSeed = 1;
/// Up to so many parts, bisections cut fewer faces (METIS manual 5.1, §4.1).
constexpr std::size_t kBisected = 8;

struct Graph {
  std::vector<idx_t> ends{0}, neighbours;
};

Graph graph_of(const Volume& volume) {
  const std::vector<Neighbours> beside = neighbours(volume.tetrahedra);
  Graph graph;
  graph.ends.reserve(beside.size() + 1);
  graph.neighbours.reserve(4 * beside.size());
  for (const Neighbours& of : beside) {
    for (const Index other : of)
      if (other != no_entity) graph.neighbours.push_back(static_cast<idx_t>(other));
    graph.ends.push_back(static_cast<idx_t>(graph.neighbours.size()));
  }
  return graph;
}

/// METIS may leave parts of small graphs empty: each takes a tetrahedron of the largest.
void fill_empty(std::vector<Index>& part_of, std::size_t parts) {
  std::vector<std::size_t> sizes(parts, 0);
  for (const Index part : part_of) ++sizes[part];
  for (std::size_t part = 0; part < parts; ++part) {
    if (sizes[part] > 0) continue;
    const auto largest = std::max_element(sizes.begin(), sizes.end());
    *std::find(part_of.begin(), part_of.end(), static_cast<Index>(largest - sizes.begin())) =
        static_cast<Index>(part);
    --*largest;
    ++sizes[part];
  }
}

/// METIS draws from the C library's one sequence of random numbers.
std::mutex& metis_mutex() {
  static std::mutex mutex;
  return mutex;
}

}  // namespace

bool has_metis() { return true; }

std::vector<Index> partition(const Volume& volume, std::size_t parts) {
  const FloatEnvironment environment;
  const std::size_t count = volume.tetrahedra.size();
  if (parts == 0) throw std::invalid_argument("a volume is partitioned into one part or more");
  if (parts > count)
    throw std::invalid_argument(counted(parts, "part") + " of a volume of " +
                                counted(count, "tetrahedron", "tetrahedra") + ": some would be empty");
  if (count > static_cast<std::size_t>(std::numeric_limits<idx_t>::max()) / 4)
    throw std::invalid_argument("METIS, as it was built, has no numbers for so many tetrahedra");
  std::vector<Index> part_of(count, 0);
  if (parts == 1) return part_of;
  Graph graph = graph_of(volume);
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = kSeed;
  options[METIS_OPTION_NUMBERING] = 0;
  idx_t vertices = static_cast<idx_t>(count), constraints = 1, wanted = static_cast<idx_t>(parts), cut = 0;
  std::vector<idx_t> found(count);
  const auto run = parts <= kBisected ? METIS_PartGraphRecursive : METIS_PartGraphKway;
  const std::lock_guard lock(metis_mutex());
  const int status = run(&vertices, &constraints, graph.ends.data(), graph.neighbours.data(), nullptr,
                         nullptr, nullptr, &wanted, nullptr, nullptr, options, &cut, found.data());
  if (status == METIS_ERROR_MEMORY) throw std::bad_alloc();
  if (status != METIS_OK) throw std::runtime_error("METIS failed with the code " + std::to_string(status));
  std::transform(found.begin(), found.end(), part_of.begin(), [](idx_t p) { return static_cast<Index>(p); });
  fill_empty(part_of, parts);
  return part_of;
}

#else

bool has_metis() { return false; }

std::vector<Index> partition(const Volume&, std::size_t) {
  throw std::runtime_error("this library was built without METIS, which makes partitions");
}

#endif

}  // namespace holdfast
