#pragma once

#include <string>

#include "netsim/demo/comparison.h"

/// The comparison as an HTML table with its footnotes. On narrow screens the style sheet turns each row into a card,
/// where each number has the name of its column. Pure functions.
namespace tandem::netsim::demo {

[[nodiscard]] std::string to_html(const Comparison& comparison);

/// Returns `<name attributes>text</name>`; `text` must be HTML.
[[nodiscard]] std::string tag(const std::string& name, const std::string& text, const std::string& attributes = "");

}  // namespace tandem::netsim::demo
