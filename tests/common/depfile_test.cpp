#include "tools/common/depfile.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

TEST(Depfile, IsARuleAndAnEmptyRuleForEachPrerequisite) {
  EXPECT_EQ(make_depfile({"out/a.stree"}, {"a.glb", "bark.png"}),
            "out/a.stree: \\\n  a.glb \\\n  bark.png\n\na.glb:\n\nbark.png:\n");
}

TEST(Depfile, EscapesWhatMakeWouldRead) {
  EXPECT_EQ(make_depfile({"o"}, {"a b"}), "o: \\\n  a\\ b\n\na\\ b:\n");
  EXPECT_EQ(make_depfile({"o"}, {"$x"}), "o: \\\n  $$x\n\n$$x:\n");
  EXPECT_EQ(make_depfile({"o"}, {"x#1"}), "o: \\\n  x\\#1\n\nx\\#1:\n");
  // A backslash before a space is one of the name's own.
  EXPECT_EQ(make_depfile({"o"}, {"x\\ y"}), "o: \\\n  x\\\\\\ y\n\nx\\\\\\ y:\n");
  EXPECT_EQ(make_depfile({"o"}, {"x\\y"}), "o: \\\n  x\\y\n\nx\\y:\n");
}

TEST(Depfile, NamesEachFileOnce) {
  EXPECT_EQ(make_depfile({"o", "o"}, {"a", "a"}), "o: \\\n  a\n\na:\n");
}

TEST(Depfile, AnOutputThatIsAnInputTooGetsNoEmptyRule) {
  EXPECT_EQ(make_depfile({"a.stree"}, {"a.stree"}), "a.stree: \\\n  a.stree\n");
}

TEST(Depfile, RefusesALineBreakInAName) {
  const auto text = make_depfile({"o"}, {"a\nb"});
  ASSERT_FALSE(text);
  EXPECT_EQ(text.error().fault, Fault::usage);
}

}  // namespace
}  // namespace copse
