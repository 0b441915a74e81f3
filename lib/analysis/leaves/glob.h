// glob: shell patterns over names, as --trunk and --leaf take them.
#pragma once

#include <string_view>

namespace copse {

// True when all of `name` matches `pattern`: `*` any characters, `?` one character (one UTF-8 code point),
// `[abc]` `[a-z]` `[!a-z]` one of a set, `\x` x itself. ASCII letters match in either case. A bracket that is
// never closed stands for itself. Never recurses; at most |pattern| * |name| steps.
bool glob_match(std::string_view pattern, std::string_view name);

}  // namespace copse
