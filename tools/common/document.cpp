#include "tools/common/document.h"

#include <algorithm>
#include <set>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace copse {
namespace {

using Json = nlohmann::ordered_json;

// Line and column of a byte, both from 1.
std::string place_of(std::string_view text, std::size_t byte) {
  const std::string_view before = text.substr(0, std::min(byte, text.size()));
  const auto line = std::count(before.begin(), before.end(), '\n') + 1;
  const std::size_t begin = before.rfind('\n');
  return fmt::format("line {} column {}", line,
                     before.size() - (begin == std::string_view::npos ? 0 : begin + 1) + 1);
}

// "syntax error while parsing value - unexpected ..." without the library's own prefix.
std::string reason_of(const std::string& what) {
  const std::size_t at = what.find("syntax error");
  std::string reason = at == std::string::npos ? what : what.substr(at);
  std::replace(reason.begin(), reason.end(), '\n', ' ');
  return reason;
}

// Of "... number overflow parsing '1e999'".
std::unexpected<Error> number_too_large(std::string_view text, std::string_view what,
                                        const std::string& file) {
  const std::size_t begin = what.find('\'') + 1;  // 0 when there is none
  const std::string_view number = what.substr(begin, what.find('\'', begin) - begin);
  return refuse(file,
                fmt::format("{}: {} is more than a number can be", place_of(text, text.find(number)), number),
                "keep it within -1.7e308 and 1.7e308");
}

}  // namespace

nlohmann::ordered_json parse_json(std::string_view text, JsonFaults& faults) {
  std::vector<std::set<std::string>> keys;
  const Json::parser_callback_t watch = [&](int depth, Json::parse_event_t event, Json& parsed) {
    if (depth > k_json_levels) faults.deep = true;
    if (event == Json::parse_event_t::object_start) keys.emplace_back();
    if (event == Json::parse_event_t::object_end) keys.pop_back();
    if (event == Json::parse_event_t::key && !keys.back().insert(parsed.get<std::string>()).second &&
        faults.twice.empty())
      faults.twice = parsed.get<std::string>();
    return !faults.deep;
  };
  return Json::parse(text, watch, true, true);
}

Result<nlohmann::ordered_json> parse_document(std::string_view text, const std::string& file) {
  JsonFaults faults;
  try {
    Json document = parse_json(text, faults);
    if (faults.deep)
      return refuse(file, fmt::format("is nested more than {} levels deep", k_json_levels),
                    "nothing that is read needs that");
    if (!faults.twice.empty())
      return refuse(file, fmt::format("the key '{}' stands twice in one object", faults.twice),
                    "keep one of them");
    return document;
  } catch (const nlohmann::json::parse_error& e) {
    return refuse(file,
                  fmt::format("{}: {}", place_of(text, e.byte == 0 ? 0 : e.byte - 1), reason_of(e.what())),
                  "mend the JSON");
  } catch (const nlohmann::json::out_of_range& e) {
    return number_too_large(text, e.what(), file);
  }
}

}  // namespace copse
