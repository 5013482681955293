#include "includes.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <string_view>

namespace rooms {
namespace {

/// The header that declares a name of namespace std. Names that several headers declare are left out.
const std::map<std::string_view, std::string_view>& header_of() {
  static const std::map<std::string_view, std::string_view> headers = {
      {"array", "array"},
      {"atomic", "atomic"},
      {"bit_cast", "bit"},
      {"countr_zero", "bit"},
      {"chrono", "chrono"},
      {"abs", "cmath"},
      {"atan2", "cmath"},
      {"cos", "cmath"},
      {"hypot", "cmath"},
      {"isfinite", "cmath"},
      {"isnan", "cmath"},
      {"sin", "cmath"},
      {"sqrt", "cmath"},
      {"int32_t", "cstdint"},
      {"int64_t", "cstdint"},
      {"uint32_t", "cstdint"},
      {"uint64_t", "cstdint"},
      {"uint8_t", "cstdint"},
      {"filesystem", "filesystem"},
      {"ifstream", "fstream"},
      {"ofstream", "fstream"},
      {"function", "functional"},
      {"numeric_limits", "limits"},
      {"map", "map"},
      {"make_unique", "memory"},
      {"shared_ptr", "memory"},
      {"unique_ptr", "memory"},
      {"numbers", "numbers"},
      {"accumulate", "numeric"},
      {"iota", "numeric"},
      {"nullopt", "optional"},
      {"optional", "optional"},
      {"mt19937_64", "random"},
      {"normal_distribution", "random"},
      {"uniform_int_distribution", "random"},
      {"uniform_real_distribution", "random"},
      {"set", "set"},
      {"span", "span"},
      {"invalid_argument", "stdexcept"},
      {"logic_error", "stdexcept"},
      {"out_of_range", "stdexcept"},
      {"runtime_error", "stdexcept"},
      {"string", "string"},
      {"to_string", "string"},
      {"string_view", "string_view"},
      {"error_code", "system_error"},
      {"system_error", "system_error"},
      {"thread", "thread"},
      {"tuple", "tuple"},
      {"unordered_map", "unordered_map"},
      {"exchange", "utility"},
      {"get_if", "variant"},
      {"holds_alternative", "variant"},
      {"variant", "variant"},
      {"vector", "vector"},
  };
  return headers;
}

std::set<std::string_view> included(const Source& source) {
  std::set<std::string_view> names;
  for (const Include& include : source.includes) names.insert(include.name);
  return names;
}

/// `a/b.hpp` of `a/b.cpp`.
std::string own_header(const std::string& path) { return path.substr(0, path.rfind('.')) + ".hpp"; }

/// The name after `std::` at a token; empty if there is none.
std::string_view standard_name(const std::vector<Token>& tokens, std::size_t at) {
  if (at + 3 >= tokens.size() || tokens[at].text != "std") return {};
  if (tokens[at + 1].text != ":" || tokens[at + 2].text != ":") return {};
  return tokens[at + 3].text;
}

Findings check_file(const Source& source, const Source* header) {
  std::set<std::string_view> seen = included(source);
  if (header != nullptr) seen.merge(included(*header));
  Findings findings;
  for (std::size_t i = 0; i < source.tokens.size(); ++i) {
    const auto found = header_of().find(standard_name(source.tokens, i));
    if (found == header_of().end() || !seen.insert(found->second).second) continue;
    findings.push_back(source.path + ":" + std::to_string(source.tokens[i].line) + ": uses std::" +
                       std::string(found->first) + " without <" + std::string(found->second) + ">");
  }
  return findings;
}

}  // namespace

Findings check_standard_headers(const std::vector<Source>& sources) {
  std::map<std::string_view, const Source*> by_path;
  for (const Source& source : sources) by_path.emplace(source.path, &source);
  Findings findings;
  for (const Source& source : sources) {
    const std::string name = own_header(source.path);
    const auto header = by_path.find(name);
    const bool has_header = name != source.path && header != by_path.end();
    std::ranges::move(check_file(source, has_header ? header->second : nullptr),
                      std::back_inserter(findings));
  }
  return findings;
}

}  // namespace rooms
