// The page: the built viewer, with texts and data in the places that it leaves for them.
#include "holdfast/names.h"
#include "holdfast/view.h"
#include "io/atomic_writer.h"
#include "view/data.h"
#include "view/embedded.h"
#include "view/packed.h"
#include "view/text.h"

namespace holdfast {
namespace {

using view::Entry;
using view::html;

/// Entries of one kind as buttons, which the page's script lets fly to their places.
void add_list(std::string& text, const std::vector<Entry>& entries, std::size_t part, Entry::Kind kind,
              const char* title, const char* tag) {
  std::string items;
  for (std::size_t i = 0; i < entries.size(); ++i)
    if (entries[i].part == part && entries[i].kind == kind)
      items += "<li><button type=\"button\" name=\"entry-" + std::to_string(i) + "\" data-entry=\"" +
               std::to_string(i) + "\">" + html(entries[i].message) + "</button></li>\n";
  if (!items.empty())
    text += std::string("<h2>") + title + "</h2>\n<" + tag + ">\n" + items + "</" + tag + ">\n";
}

std::string defects_text(const Page& page, const std::vector<Entry>& entries) {
  std::string text;
  for (std::size_t part = 0; part < page.parts.size(); ++part) {
    const PagePart& of = page.parts[part];
    if (of.volume != nullptr) continue;
    add_list(text, entries, part, Entry::Kind::cause, "By cause", "ul");
    add_list(text, entries, part, Entry::Kind::gap, "Vertices that are almost one", "ol");
    add_list(text, entries, part, Entry::Kind::defect, "Defects", "ol");
    if (of.defects.size() > view::kMostEntries)
      text +=
          "<p>and " + std::to_string(of.defects.size() - view::kMostEntries) + " more in the report</p>\n";
  }
  return text.empty() ? "<p>No defects are told of.</p>" : text;
}

std::string verdict_text(const Page& page) {
  std::string text =
      "<p class=\"" + std::string(page.good ? "good" : "bad") + "\">" +
      html(page.verdict.empty() ? "This page only shows; nothing was checked." : page.verdict) + "</p>\n";
  if (page.rules.empty()) return text;
  text += "<table>\n";
  for (const Rule& rule : page.rules)
    text += "<tr><th class=\"" + std::string(rule.holds ? "good\">holds" : "bad\">BROKEN") + "</th><td>" +
            html(rule.name) + "</td><td>" + html(rule.detail) + "</td></tr>\n";
  return text + "</table>\n";
}

std::string report_text(const Page& page) {
  return page.report.empty() ? "<p>There is no report.</p>" : "<pre>" + html(page.report) + "</pre>";
}

}  // namespace

void write_page(const std::filesystem::path& path, const Page& page, const PageOptions& options) {
  io::Watch watch(options, options.progress);
  const std::vector<Entry> entries = view::entries_of(page);
  const std::string data = view::base64(view::packed(page, entries, options.most_tetrahedra, watch));
  io::AtomicWriter out(path, &watch);
  std::string_view rest = view::page_template();
  const auto fill = [&](std::string_view mark, std::string_view text) {
    const std::size_t at = rest.find(mark);
    out << rest.substr(0, at) << text;
    rest.remove_prefix(at + mark.size());
  };
  fill("@TITLE@", html(page.title));
  fill("@DEFECTS@", defects_text(page, entries));
  fill("@VERDICT@", verdict_text(page));
  fill("@REPORT@", report_text(page));
  fill("@DATA@", data);
  out << rest;
  out.commit();
  watch.finish_written();
}

std::string page_data(const Page& page, const PageOptions& options) {
  io::Watch watch(options, options.progress);
  return view::packed(page, view::entries_of(page), options.most_tetrahedra, watch);
}

}  // namespace holdfast
