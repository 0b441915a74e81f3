// A tree with everything that tools add to one.
#pragma once

#include "tests/tools/little_obj.h"
#include "tests/tools/process.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace copse {

// rich.obj and rich.stree: volumes of the whole and of groups at rest and swaying by 4 degrees, and levels of
// half and a fifth of the triangles. Full detail reaches 9 m, or 10 without hysteresis.
inline void write_rich_tree(const TemporaryFolder& folder) {
  write_text(folder.file("rich.obj"), little_tree_obj(6, 9, 40));
  for (std::vector<std::string> command :
       {std::vector<std::string>{"treeprep", "rich.obj", "-o", "rich.stree"},
        {"bvfit", "rich.stree", "-o", "rich.stree", "--per", "whole,groups", "--sway", "4"},
        {"lodbake", "rich.stree", "-o", "rich.stree", "--continuous", "--discrete", "0.5,0.2", "--near", "10",
         "--far", "40"}}) {
    for (std::string& word : command)
      if (word.starts_with("rich")) word = folder.file(word);
    const Outcome o = run_process(command);
    ASSERT_EQ(o.status, 0) << command[0] << ": " << o.err;
  }
}

}  // namespace copse
