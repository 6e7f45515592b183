// Writes Nastran's bulk data, .bdf (MSC Nastran quick reference guide, "Bulk data entries"): coordinates in
// fields of 16 characters, elements in fields of 8. Properties are the regions and markers, with names in
// comments as HyperMesh writes them. Exact coordinates are in comments, too (exact_nodes.h).
#include <charconv>
#include <cmath>

#include "io/exact_nodes.h"
#include "io/solver_text.h"
#include "text/parse.h"

namespace holdfast::io {
namespace {

constexpr NameRule kBdfNames{64, "_-."};
constexpr std::int64_t kBdfMost = 99999999;  // eight digits
constexpr std::size_t kWideField = 16;

struct BdfLabels {
  Labels regions, facets;
};

/// Shells and solids have distinct property numbers.
BdfLabels labels_of(const Volume& volume) {
  const Names& names = volume.names;
  Labels regions = labels_of(kRegionStem, volume.regions, volume.tetrahedra.size(), names.regions, kBdfNames,
                             {true, static_cast<int>(kBdfMost)});
  const std::set<int> taken(regions.ids.begin(), regions.ids.end());
  Labels facets = labels_of(kFacetStem, volume.facet_markers, volume.facets.size(), names.facets, kBdfNames,
                            {true, static_cast<int>(kBdfMost), &taken});
  return {std::move(regions), std::move(facets)};
}

/// Writes text at the left of a field.
void field(AtomicWriter& out, std::string_view text, std::size_t width) {
  out << text;
  for (std::size_t i = text.size(); i < width; ++i) out << ' ';
}

void field(AtomicWriter& out, std::int64_t value) {
  char digits[24];
  const auto result = std::to_chars(digits, digits + sizeof digits, value);
  field(out, std::string_view(digits, static_cast<std::size_t>(result.ptr - digits)), 8);
}

/// "1.5e-07" as "1.5-7", with a point, as Nastran requires.
std::string without_e(std::string_view number) {
  std::string mantissa(number.substr(0, number.find('e')));
  if (mantissa.find('.') == std::string::npos) mantissa += '.';
  if (mantissa.size() == number.size() + 1 || number.find('e') == std::string_view::npos) return mantissa;
  std::string_view exponent = number.substr(number.find('e') + 1);
  const char sign = exponent[0];
  exponent.remove_prefix(1);
  while (exponent.size() > 1 && exponent[0] == '0') exponent.remove_prefix(1);
  return mantissa + sign + std::string(exponent);
}

/// The double of such a text; infinite if rounding up leaves the range.
double value_of(std::string number) {
  const std::size_t sign = number.find_last_of("+-");
  if (sign != std::string::npos && sign > 0) number.insert(sign, 1, 'e');
  double value = 0;
  const auto result = parse_double(number.data(), number.data() + number.size(), value);
  return result.ec == std::errc() ? value : HUGE_VAL;
}

}  // namespace

std::string nastran_real(double value) {
  char digits[400];
  const auto text = [&](auto... how) {
    const auto result = std::to_chars(digits, digits + sizeof digits, value, how...);
    return without_e(std::string_view(digits, static_cast<std::size_t>(result.ptr - digits)));
  };
  // The shortest exact text, if it fits.
  for (const std::string& exact : {text(), text(std::chars_format::scientific)})
    if (exact.size() <= kWideField) return exact;
  const bool plain = std::fabs(value) >= 0.001 && std::fabs(value) < 1e14;
  for (int figures = 15; figures > 0; --figures) {
    // Without an exponent there is room for more digits.
    const std::string number =
        plain ? text(std::chars_format::fixed, figures) : text(std::chars_format::scientific, figures);
    if (number.size() <= kWideField && std::isfinite(value_of(number))) return number;
    if (number.starts_with("0.") && number.size() == kWideField + 1) return number.substr(1);
    if (number.starts_with("-0.") && number.size() == kWideField + 1) return "-" + number.substr(2);
  }
  return text(std::chars_format::scientific, 5);
}

double nastran_rounded(double value) { return value_of(nastran_real(value)); }

void write_bdf(AtomicWriter& out, const Volume& volume) {
  const std::size_t elements = volume.tetrahedra.size() + volume.facets.size();
  if (node_count(volume) > kBdfMost || elements > kBdfMost)
    throw std::invalid_argument("a mesh of more than 99999999 nodes or elements does not fit .bdf");
  const BdfLabels labels = labels_of(volume);
  out << "$ mesh by Holdfast\n";
  for (const Labels* of : {&labels.regions, &labels.facets})
    for (const auto& [id, name] : of->names) {
      char digits[16];
      const auto result = std::to_chars(digits, digits + sizeof digits, id);
      const std::string_view number(digits, static_cast<std::size_t>(result.ptr - digits));
      out << "$HMNAME PROP" << std::string(20 - number.size(), ' ') << number << '"' << name << "\"\n";
    }
  // The original markers of shells whose property has another number.
  if (!labels.facets.renumbered.empty()) {
    Labels original = labels.facets;
    original.names.clear();
    for (const auto& [id, number] : labels.facets.renumbered)
      original.names[id] = labels.facets.names.at(number);
    write_id_comments(out, "$", original);
  }
  write_exact_nodes(out, volume, "$", nastran_rounded);
  out << "BEGIN BULK\n";
  for (std::size_t i = 0; i < node_count(volume); ++i) {
    beat(out.watch());
    const Point& p = node(volume, i);
    field(out, "GRID*", 8);
    field(out, std::to_string(i + 1), kWideField);
    field(out, "", kWideField);
    field(out, nastran_real(p[0]), kWideField);
    field(out, nastran_real(p[1]), kWideField);
    out << "\n*       " << nastran_real(p[2]) << '\n';
  }
  std::int64_t number = 0;
  const auto element = [&](std::string_view card, int property, const Nodes& nodes) {
    beat(out.watch());
    field(out, card, 8);
    field(out, ++number);
    field(out, property);
    std::size_t on_line = 2;
    for (const Index v : nodes) {
      if (on_line == 8) out << "+\n+       ";  // Gmsh goes on to the next line by this alone
      on_line = on_line == 8 ? 1 : on_line + 1;
      field(out, std::int64_t{v} + 1);
    }
    out << '\n';
  };
  for (std::size_t i = 0; i < volume.tetrahedra.size(); ++i)
    element("CTETRA", labels.regions.ids[i], tetrahedron_nodes(volume, i, kVtkEdges));
  for (std::size_t i = 0; i < volume.facets.size(); ++i)
    element(is_second_order(volume) ? "CTRIA6" : "CTRIA3", labels.facets.ids[i], facet_nodes(volume, i));
  out << "ENDDATA\n";
}

std::vector<Remark> not_in_bdf(const Volume& volume, const WriteOptions&) {
  std::vector<Remark> remarks;
  const BdfLabels labels = labels_of(volume);
  tell(labels.regions, ".bdf", remarks);
  tell(labels.facets, ".bdf", remarks);
  tell_left_out(volume, ".bdf", false, true, remarks);
  return remarks;
}

}  // namespace holdfast::io
