// Results as tuples that Python can pickle: field by field, and back.
//
// `fields_of` lists the fields of a result. Numbers in a row are arrays, so neither their size nor their byte
// order depends on the machine. Text is bytes, because names of files may not be UTF-8.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <concepts>
#include <cstdint>
#include <memory>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "holdfast/paste.h"
#include "holdfast/repair.h"
#include "holdfast/types.h"
#include "repaired.h"

namespace holdfast::python {

namespace py = pybind11;

template <class A, class B>
concept Is = std::same_as<std::remove_const_t<A>, B>;

/// `To`, const if `From` is const.
template <class To, class From>
[[nodiscard]] auto& as(From& from) {
  return static_cast<std::conditional_t<std::is_const_v<From>, const To, To>&>(from);
}

// clang-format off
template <Is<Names> T> auto fields_of(T& n) { return std::tie(n.facets, n.regions, n.segments, n.vertices); }
template <Is<Remark> T> auto fields_of(T& r) { return std::tie(r.kind, r.count, r.message); }
template <Is<Surface::RegionSeed> T> auto fields_of(T& s) { return std::tie(s.where, s.id, s.size, s.max_volume); }
template <Is<IndexLists> T> auto fields_of(T& l) { return std::tie(l.first, l.all); }
template <Is<RepairResult::Moved> T> auto fields_of(T& m) { return std::tie(m.vertex, m.distance); }
template <Is<RepairResult::Dropped> T> auto fields_of(T& d) { return std::tie(d.facet, d.reason); }
template <Is<RepairResult::Merged> T> auto fields_of(T& m) { return std::tie(m.facet, m.into); }
template <Is<RepairResult::Filled> T> auto fields_of(T& f) { return std::tie(f.border, f.facets, f.is_plane); }
template <Is<RepairResult::LeftOpen> T> auto fields_of(T& l) { return std::tie(l.border, l.reason); }
template <Is<PartOverlap> T> auto fields_of(T& o) { return std::tie(o.first, o.second, o.depth, o.thickness, o.where); }
template <Is<PartApart> T> auto fields_of(T& a) { return std::tie(a.part, a.nearest, a.distance, a.where); }
template <Is<MidNodes> T> auto fields_of(T& m) { return std::tie(m.points, m.tetrahedra, m.facets, m.segments); }
template <Is<PastedPart> T> auto fields_of(T& p) {
  return std::tie(p.name, p.first_vertex, p.first_facet, p.id, p.seeds, p.holes);
}
template <Is<Surface> T> auto fields_of(T& s) {
  return std::tie(s.vertices, s.facets, s.segments, s.facet_markers, s.segment_markers, s.vertex_markers, s.regions,
                  s.holes, s.remarks, s.names);
}
template <Is<Volume> T> auto fields_of(T& v) {
  return std::tie(v.vertices, v.tetrahedra, v.regions, v.facets, v.facet_markers, v.segments, v.segment_markers,
                  v.vertex_markers, v.input_vertices, v.names, v.mid_nodes);
}
template <Is<RepairReport> T> auto fields_of(T& r) {
  return std::tie(r.vertices, r.facets, r.segments, r.pairs, r.sheets, r.points, r.rounds, r.rung, r.changed_facets,
                  r.seconds, r.peak_memory_bytes);
}
template <Is<RepairResult> T> auto fields_of(T& r) {
  return std::tie(r.outcome, r.surface, r.parents, r.segment_parents, r.moved, r.dropped, r.merged, r.filled,
                  r.left_open, r.marker_sets, r.max_displacement, r.report, r.message);
}
/// Of its options, only those that its report and a check of it name.
template <Is<Repair> T> auto fields_of(T& r) {
  return std::tie(r.result, r.options.weld, r.options.join, r.options.fill_holes, r.options.unite, r.options.threads);
}
template <Is<PasteResult> T> auto fields_of(T& r) {
  return std::tuple_cat(fields_of(as<RepairResult>(r)),
                        std::tie(r.parts, r.part_of_facet, r.overlaps, r.apart, r.overlap, r.gap, r.shared_facets, r.turned));
}
template <Is<PastedVolumes> T> auto fields_of(T& r) {
  return std::tie(r.outcome, r.volume, r.origin, r.replaced, r.boundary, r.message);
}
// clang-format on

template <class T>
concept Number = std::is_arithmetic_v<T>;
/// A fixed number of numbers, one after another.
template <class T>
concept Row = requires {
  requires Number<typename T::value_type>;
  std::tuple_size<T>::value;
};

template <class T>
[[nodiscard]] py::object state_of(const T& value);
template <class T>
void set_state(T& value, const py::handle& state);

template <class T>
[[nodiscard]] py::array_t<T> array_with(const T* values, std::size_t count) {
  return py::array_t<T>(static_cast<py::ssize_t>(count), values);
}

template <class T>
void take_array(const py::handle& state, std::size_t columns, std::vector<T>& values) {
  const auto array =
      py::array_t<T, py::array::c_style | py::array::forcecast>(py::reinterpret_borrow<py::object>(state));
  if (array.size() % static_cast<py::ssize_t>(columns) != 0) throw py::value_error("no whole rows");
  values.assign(array.data(), array.data() + array.size());
}

template <class T>
[[nodiscard]] py::object list_of(const std::vector<T>& values) {
  if constexpr (Number<T>) {
    return array_with(values.data(), values.size());
  } else if constexpr (Row<T>) {
    return array_with(values.empty() ? nullptr : values.data()->data(), values.size() * std::tuple_size_v<T>);
  } else {
    py::list list;
    for (const T& value : values) list.append(state_of(value));
    return list;
  }
}

template <class T>
void set_list(std::vector<T>& values, const py::handle& state) {
  if constexpr (Number<T>) {
    take_array(state, 1, values);
  } else if constexpr (Row<T>) {
    constexpr std::size_t columns = std::tuple_size_v<T>;
    std::vector<typename T::value_type> flat;
    take_array(state, columns, flat);
    values.resize(flat.size() / columns);
    for (std::size_t i = 0; i < flat.size(); ++i) values[i / columns][i % columns] = flat[i];
  } else {
    values.clear();
    for (const py::handle item : state) set_state(values.emplace_back(), item);
  }
}

template <class T>
inline constexpr bool is_vector = false;
template <class T>
inline constexpr bool is_vector<std::vector<T>> = true;
template <class T>
inline constexpr bool is_map = false;
template <class K, class T>
inline constexpr bool is_map<std::map<K, T>> = true;
template <class T>
inline constexpr bool is_optional = false;
template <class T>
inline constexpr bool is_optional<std::optional<T>> = true;
template <class T>
inline constexpr bool is_array = false;
template <class T, std::size_t n>
inline constexpr bool is_array<std::array<T, n>> = true;

template <class T>
py::object state_of(const T& value) {
  if constexpr (Number<T>) {
    return py::cast(value);
  } else if constexpr (std::is_enum_v<T>) {
    return py::int_(static_cast<int>(value));
  } else if constexpr (std::same_as<T, std::string>) {
    return py::bytes(value);
  } else if constexpr (is_vector<T>) {
    return list_of(value);
  } else if constexpr (is_optional<T>) {
    return value ? state_of(*value) : py::none();
  } else if constexpr (is_map<T>) {
    py::list pairs;
    for (const auto& [key, one] : value) pairs.append(py::make_tuple(state_of(key), state_of(one)));
    return pairs;
  } else if constexpr (is_array<T>) {
    py::list items;
    for (const auto& item : value) items.append(state_of(item));
    return items;
  } else {
    py::list fields;
    std::apply([&](const auto&... field) { (fields.append(state_of(field)), ...); }, fields_of(value));
    return py::tuple(fields);
  }
}

template <class T>
void set_state(T& value, const py::handle& state) {
  if constexpr (Number<T>) {
    value = py::cast<T>(state);
  } else if constexpr (std::is_enum_v<T>) {
    value = static_cast<T>(py::cast<int>(state));
  } else if constexpr (std::same_as<T, std::string>) {
    value = std::string(py::cast<py::bytes>(state));
  } else if constexpr (is_vector<T>) {
    set_list(value, state);
  } else if constexpr (is_optional<T>) {
    value.reset();
    if (!state.is_none()) set_state(value.emplace(), state);
  } else if constexpr (is_map<T>) {
    value.clear();
    for (const py::handle pair : state) {
      const auto both = py::cast<py::tuple>(pair);
      typename T::key_type key{};
      set_state(key, both[0]);
      set_state(value[key], both[1]);
    }
  } else if constexpr (is_array<T>) {
    const auto items = py::cast<py::list>(state);
    if (items.size() != value.size()) throw py::value_error("another number of items");
    for (std::size_t i = 0; i < value.size(); ++i) set_state(value[i], items[i]);
  } else {
    const auto fields = py::cast<py::tuple>(state);
    std::size_t at = 0;
    std::apply(
        [&](auto&... field) {
          if (fields.size() != sizeof...(field))
            throw py::value_error("pickled by another version of Holdfast");
          (set_state(field, fields[at++]), ...);
        },
        fields_of(value));
  }
}

/// For py::class_: makes a result picklable and copyable in Python.
template <class T>
[[nodiscard]] auto pickled() {
  return py::pickle([](const T& result) { return py::cast<py::tuple>(state_of(result)); },
                    [](const py::tuple& state) {
                      auto result = std::make_shared<T>();
                      set_state(*result, state);
                      return result;
                    });
}

}  // namespace holdfast::python
