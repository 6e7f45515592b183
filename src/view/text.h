// Foreign text inside a page: in HTML and in JSON, where nothing of it may become markup or script.
#pragma once

#include <string>
#include <string_view>

namespace holdfast::view {

/// What is no UTF-8, and control characters but for the line feed, as U+FFFD.
[[nodiscard]] std::string clean(std::string_view text);

/// For the content of an element or an attribute in quotes: & < > " ' become references.
[[nodiscard]] std::string html(std::string_view text);

/// As a JSON string with its quotes.
[[nodiscard]] std::string json(std::string_view text);

/// A number, or null for one that JSON does not know.
[[nodiscard]] std::string json(double value);

}  // namespace holdfast::view
