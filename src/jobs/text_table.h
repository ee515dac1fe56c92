#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gramloom {

using Row = std::vector<std::string>;

/// Columns of text, each as wide as its longest cell (up to a limit); the last one is not filled
/// up. Every line begins with `indent`.
std::string text_table(const std::vector<Row>& rows, std::string_view indent);

}  // namespace gramloom
