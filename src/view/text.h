// Foreign text inside a page, escaped for HTML and JSON so that none of it becomes markup or script.
#pragma once

#include <string>
#include <string_view>

namespace holdfast::view {

/// Replaces invalid UTF-8, and control characters other than the line feed, by U+FFFD.
[[nodiscard]] std::string clean(std::string_view text);

/// For the content of an element or a quoted attribute: & < > " ' become references.
[[nodiscard]] std::string html(std::string_view text);

/// A JSON string with its quotes.
[[nodiscard]] std::string json(std::string_view text);

/// A number, or null if JSON has no such number.
[[nodiscard]] std::string json(double value);

}  // namespace holdfast::view
