#include "tools/common/response_file.h"

#include "lib/formats/container/mapped_file.h"

#include <utility>

#include <fmt/format.h>

namespace copse {
namespace {

constexpr std::string_view k_white = " \t\n\r\f\v";

bool is_white(char c) {
  return k_white.find(c) != std::string_view::npos;
}

bool names_response_file(const std::string& argument) {
  return argument.size() > 1 && argument.front() == '@';
}

Result<std::vector<std::string>> read_arguments(const std::string& path, std::uint64_t& bytes_left) {
  const auto file = MappedFile::open(path);
  if (!file) return std::unexpected(file.error());
  const std::span<const std::uint8_t> bytes = file->bytes();
  if (bytes.size() > bytes_left) {
    return fail(Fault::usage, path, fmt::format("response files hold more than {} bytes", k_response_bytes),
                "split the work over several calls");
  }
  bytes_left -= bytes.size();
  return split_arguments({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path);
}

// Arguments still to be looked at, the next one last; `depth` files deep.
struct Waiting {
  std::string argument;
  int depth = 0;
};

}  // namespace

Result<std::vector<std::string>> split_arguments(std::string_view text, const std::string& name) {
  std::vector<std::string> arguments;
  std::string current;
  bool inside = false;  // an argument has begun, be it an empty one: ""
  char quote = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '\\' && i + 1 < text.size()) {
      current += text[++i];
      inside = true;
    } else if (quote != 0) {
      if (c == quote) {
        quote = 0;
      } else {
        current += c;
      }
    } else if (c == '\'' || c == '"') {
      quote = c;
      inside = true;
    } else if (!is_white(c)) {
      current += c;
      inside = true;
    } else if (inside) {
      arguments.push_back(std::exchange(current, {}));
      inside = false;
    }
  }
  if (quote != 0) {
    return fail(Fault::usage, name, fmt::format("the quote {} is never closed", quote),
                "close it, or write \\ before a quote that is meant literally");
  }
  if (inside) arguments.push_back(std::move(current));
  return arguments;
}

Result<ExpandedArguments> expand_response_files(const std::vector<std::string>& arguments) {
  ExpandedArguments expanded;
  std::vector<Waiting> waiting;
  std::uint64_t bytes_left = k_response_bytes;
  for (auto it = arguments.rbegin(); it != arguments.rend(); ++it) waiting.push_back({*it, 0});
  bool literal = false;
  while (!waiting.empty()) {
    Waiting next = std::move(waiting.back());
    waiting.pop_back();
    literal = literal || next.argument == "--";
    if (literal || !names_response_file(next.argument)) {
      expanded.arguments.push_back(std::move(next.argument));
      continue;
    }
    const std::string path = next.argument.substr(1);
    if (next.depth == k_response_depth) {
      return fail(Fault::usage, path,
                  fmt::format("response files name each other more than {} deep", k_response_depth),
                  "a file may not name itself; flatten the files");
    }
    auto inner = read_arguments(path, bytes_left);
    if (!inner) return std::unexpected(std::move(inner.error()));
    expanded.files.emplace_back(path);
    if (inner->size() + waiting.size() + expanded.arguments.size() > k_response_args) {
      return fail(Fault::usage, path, fmt::format("more than {} arguments", k_response_args),
                  "split the work over several calls");
    }
    for (auto it = inner->rbegin(); it != inner->rend(); ++it) {
      waiting.push_back({std::move(*it), next.depth + 1});
    }
  }
  return expanded;
}

}  // namespace copse
