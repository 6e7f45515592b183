// viewer/dist/viewer.html inside the library: the page without its data (cmake/embed.cmake).
#pragma once

#include <string_view>

namespace holdfast::view {

/// With the marks @TITLE@ @DEFECTS@ @VERDICT@ @REPORT@ @DATA@, each once and in this order.
[[nodiscard]] std::string_view page_template();

}  // namespace holdfast::view
