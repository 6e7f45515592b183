// The library as a WebAssembly module: one function that takes a request and gives a response, both JSON,
// about files in the module's own file system, where JavaScript (web/src/core.ts) puts and takes them.
#include <emscripten.h>

#include <algorithm>
#include <string>

#include "arrays.h"
#include "holdfast/holdfast.h"
#include "holdfast/io.h"
#include "holdfast/names.h"
#include "holdfast/paste.h"
#include "holdfast/repair.h"
#include "holdfast/surface_io.h"
#include "holdfast/view.h"
#include "reports.h"
#include "request.h"

namespace holdfast::web {
namespace {

using reports::to_json;

/// What is meshed: one surface, or the parts of several files.
struct Input {
  Surface surface;
  std::vector<Surface> parts;  ///< where there are several files
  std::vector<std::string> names;
};

Input read_input(const Json& request) {
  Input input;
  if (request.value("surface_arrays", false)) {
    input.surface = surface_of_arrays(request);
    return input;
  }
  const std::vector<std::filesystem::path> files = inputs_of(request);
  for (const auto& file : files) input.parts.push_back(read_surface(file, reading(request)));
  input.names = stems(files);
  if (files.size() > 1) {
    input.surface = join(input.parts, input.names);
  } else {
    input.surface = std::move(input.parts.front());
    input.parts.clear();
  }
  return input;
}

Volume read_volume(const Json& request) {
  if (request.value("volume_arrays", false)) return volume_of_arrays(request);
  return holdfast::read_volume(request.at("volume").get<std::string>(), reading(request));
}

/// As the program does: several files with triangles in common are parts.
Result mesh_of(const Input& input, const Json& request) {
  if (!input.parts.empty()) {
    PasteOptions pasting;
    static_cast<Limits&>(pasting) = reading(request);
    pasting.cut = false;
    pasting.judge = false;
    pasting.labels = input.names;
    const PasteResult pasted = paste(input.parts, pasting, input.names);
    if (pasted.shared_facets > 0) {
      const Options options = mesh_options(request, pasted.surface);
      if (pasted.outcome == Outcome::done) return mesh(pasted, options);
      Result result;
      result.outcome = pasted.outcome;
      result.message = pasted.message;
      return result;
    }
  }
  return mesh(input.surface.view(), mesh_options(request, input.surface));
}

/// A page with what a call has found or made; none unless the request asks for one.
class PageOfCall {
 public:
  explicit PageOfCall(const Json& request) : request_(request) {}

  void add(const std::string& name, const Volume& volume) {
    page_.parts.emplace_back().name = name;
    page_.parts.back().volume = &volume;
  }
  void add(const std::string& name, const Surface& surface, const std::vector<Defect>& defects,
           const DefectSummary& summary) {
    PagePart& part = page_.parts.emplace_back();
    part.name = name;
    part.complex = surface.view();
    part.defects = defects;
    part.summary = defects.empty() ? nullptr : &summary;
  }

  void write(bool good, const std::string& verdict, Json report) {
    if (!request_.contains("page")) return;
    for (const char* list : {"vertex_map", "defects", "parents", "summary"}) report.erase(list);
    page_.title = request_.value("title", std::string());
    page_.good = good;
    page_.verdict = verdict;
    page_.report = reports::text_of(report, 2);
    PageOptions options;
    static_cast<Limits&>(options) = reading(request_);
    options.progress = [](double share) { return goes_on(share, "show"); };
    options.most_tetrahedra = request_.value("most_tetrahedra", options.most_tetrahedra);
    write_page(request_["page"].get<std::string>(), page_, options);
  }

 private:
  const Json& request_;
  Page page_;
};

Json options_of(const Json& request) { return request.value("options", Json::object()); }

Json mesh_call(const Json& request) {
  const Input input = read_input(request);
  const Result result = mesh_of(input, request);
  const bool done = result.outcome == Outcome::done;
  Json report = to_json(result, options_of(request));
  if (done && request.contains("output"))
    write_volume(request["output"].get<std::string>(), result.volume, writing(request));
  if (done && request.value("arrays", false)) give(result.volume, report);
  const DefectSummary summary = summarise(input.surface.view(), result.defects);
  if (!result.defects.empty()) report["summary"] = to_json(summary);
  report["remarks"] = to_json(input.surface.remarks);
  PageOfCall page(request);
  if (done) page.add("mesh", result.volume);
  if (!done || !result.defects.empty()) page.add("surface", input.surface, result.defects, summary);
  page.write(done, done ? std::to_string(result.report.tetrahedra) + " tetrahedra" : result.message, report);
  return report;
}

DiagnoseOptions diagnosing(const Json& request) {
  DiagnoseOptions options;
  static_cast<Limits&>(options) = reading(request);
  options.progress = [](double share) { return goes_on(share, "diagnose"); };
  return options;
}

Json diagnose_call(const Json& request) {
  require_known(options_of(request), {"most"});
  DiagnoseOptions options = diagnosing(request);
  options.most = options_of(request).value("most", std::size_t{SIZE_MAX});
  const Surface surface = read_input(request).surface;
  const std::vector<Defect> defects = diagnose(surface.view(), options);
  const DefectSummary summary = summarise(surface.view(), defects);
  Json response = {{"outcome", "done"},
                   {"valid", defects.empty()},
                   {"vertices", surface.vertices.size()},
                   {"triangles", surface.facets.size()},
                   {"segments", surface.segments.size()},
                   {"summary", to_json(summary)},
                   {"defects", to_json(defects)},
                   {"remarks", to_json(surface.remarks)}};
  PageOfCall page(request);
  page.add("surface", surface, defects, summary);
  page.write(defects.empty(), defects.empty() ? "the surface is valid" : "the surface is not valid",
             response);
  return response;
}

Json repair_call(const Json& request) {
  const RepairOptions options = repair_options(request);
  const Surface surface = read_input(request).surface;
  RepairResult result = repair(surface.view(), options);
  result.surface.regions = surface.regions;
  result.surface.holes = surface.holes;
  const bool done = result.outcome == Outcome::done;
  Json report = to_json(result, options_of(request));
  if (done && request.contains("output"))
    write_surface(request["output"].get<std::string>(), result.surface, writing(request));
  if (done && request.value("arrays", false)) give(result.surface, report);
  if (request.contains("page")) {
    const std::vector<Defect> defects = diagnose(surface.view(), diagnosing(request));
    const DefectSummary before = summarise(surface.view(), defects), none;
    PageOfCall page(request);
    if (done) page.add("after", result.surface, {}, none);
    page.add("before", surface, defects, before);
    page.write(done, done ? "repaired" : result.message, report);
  }
  return report;
}

Json check_call(const Json& request) {
  const Json given = options_of(request);
  require_known(given, {"outside_dropped", "box"});
  CheckOptions options;
  static_cast<Limits&>(options) = limits_of(given);
  options.outside_dropped = given.value("outside_dropped", false);
  options.box = given.value("box", false);
  options.progress = [](double share) { return goes_on(share, "check"); };
  const Surface surface = read_input(request).surface;
  Json response = to_json(check(surface.view(), read_volume(request), options));
  response["outcome"] = "done";
  return response;
}

/// A file to arrays, or arrays or a file to a file.
Json surface_call(const Json& request) {
  const Surface surface = read_input(request).surface;
  Json response = {{"outcome", "done"}, {"remarks", to_json(surface.remarks)}};
  if (request.contains("output")) {
    require_whole(surface);
    const std::filesystem::path path = request["output"].get<std::string>();
    write_surface(path, surface, writing(request));
    response["not_held"] = to_json(not_held(path, surface, writing(request)));
  }
  if (request.value("arrays", false)) give(surface, response);
  return response;
}

Json volume_call(const Json& request) {
  const Volume volume = read_volume(request);
  Json response = {{"outcome", "done"}};
  if (request.contains("output")) {
    const std::filesystem::path path = request["output"].get<std::string>();
    write_volume(path, volume, writing(request));
    response["not_held"] = to_json(not_held(path, volume, writing(request)));
  }
  if (request.value("arrays", false)) give(volume, response);
  return response;
}

Json answer(const Json& request) {
  const std::string call = request.at("call");
  if (call == "mesh") return mesh_call(request);
  if (call == "diagnose") return diagnose_call(request);
  if (call == "repair") return repair_call(request);
  if (call == "check") return check_call(request);
  if (call == "surface") return surface_call(request);
  if (call == "volume") return volume_call(request);
  if (call == "about")
    return {{"outcome", "done"},
            {"version", version()},
            {"volume_formats", volume_formats()},
            {"readable_volume_formats", readable_volume_formats()},
            {"surface_formats", surface_formats()}};
  throw std::invalid_argument("there is no call '" + call + "'");
}

Json failure(const char* outcome, const char* message) {
  return {{"outcome", outcome}, {"message", message}};
}

}  // namespace
}  // namespace holdfast::web

/// The response stands until the next call. Failures have an outcome that is none of the library's
/// ("file_error", "bad_argument", "out_of_memory", "too_large", "internal_error", as in holdfast/c.h) or that
/// of a limit.
extern "C" EMSCRIPTEN_KEEPALIVE const char* holdfast_call(const char* request) {
  static std::string response;
  using holdfast::web::failure;
  using holdfast::web::Json;
  Json json;
  try {
    json = holdfast::web::answer(Json::parse(request));
  } catch (const holdfast::Interrupted& interrupted) {
    json = failure(holdfast::name(interrupted.outcome()), interrupted.what());
  } catch (const holdfast::FileError& error) {
    json = failure("file_error", error.what());
    json["file"] = error.path().string();
    json["where"] = error.where();
  } catch (const std::bad_alloc&) {
    json = failure("out_of_memory", "there is no more memory");
  } catch (const std::length_error& error) {
    json = failure("too_large", error.what());
  } catch (const std::invalid_argument& error) {
    json = failure("bad_argument", error.what());
  } catch (const Json::exception& error) {
    json = failure("bad_argument", error.what());
  } catch (const std::exception& error) {
    json = failure("internal_error", error.what());
  }
  response = holdfast::reports::text_of(json);
  return response.c_str();
}
