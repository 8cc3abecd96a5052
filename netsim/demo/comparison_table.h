#pragma once

#include <string>

#include "netsim/demo/comparison.h"

/// The comparison as an HTML table with its footnotes. On narrow screens the style sheet turns each row into a card, in
/// which every number carries the name of its column. Pure.
namespace tandem::netsim::demo {

[[nodiscard]] std::string to_html(const Comparison& comparison);

/// `<name attributes>text</name>`; the text is HTML already.
[[nodiscard]] std::string tag(const std::string& name, const std::string& text, const std::string& attributes = "");

}  // namespace tandem::netsim::demo
