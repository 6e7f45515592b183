// viewer/dist/viewer.html, embedded in the library: the page without its data (cmake/embed.cmake).
#pragma once

#include <string_view>

namespace holdfast::view {

/// The page with the marks @TITLE@ @DEFECTS@ @VERDICT@ @REPORT@ @DATA@, each once and in this order.
[[nodiscard]] std::string_view page_template();

}  // namespace holdfast::view
