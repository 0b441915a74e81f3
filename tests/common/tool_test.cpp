// run_tool as a user meets it: a real process (probe/main.cpp), its status and what it leaves behind.
#include "tests/tools/process.h"

#include <algorithm>
#include <csignal>
#include <sstream>
#include <thread>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>
#include <unistd.h>

namespace copse {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class Tool : public testing::Test {
 protected:
  static Outcome probe(std::vector<std::string> arguments, const std::vector<std::string>& environment = {}) {
    arguments.insert(arguments.begin(), "common_probe");
    return run_process(arguments, environment);
  }
  // `command` with %P for the probe and %D for the folder.
  Outcome shell(std::string command) const {
    for (const auto& [name, value] :
         {std::pair{std::string("%P"), std::string(COPSE_BIN_DIR) + "/common_probe"},
          std::pair{std::string("%D"), folder_.path().string()}}) {
      for (std::size_t at = command.find(name); at != std::string::npos;
           at = command.find(name, at + value.size())) {
        command.replace(at, name.size(), value);
      }
    }
    return run_process({"/bin/sh", "-c", command});
  }
  std::size_t files() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator()));
  }
  std::string file(const std::string& name) const { return folder_.file(name); }

  TemporaryFolder folder_;
};

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

// --- help, version, limits

TEST_F(Tool, HelpFitsTheTerminalAndEndsWithTwoWorkedExamples) {
  for (const int width : {44, 80, 200}) {
    const Outcome o = probe({"--help"}, {std::string("COLUMNS=") + std::to_string(width)});
    EXPECT_EQ(o.status, 0);
    EXPECT_EQ(o.err, "");
    const std::vector<std::string> lines = lines_of(o.out);
    for (const std::string& line : lines) {
      const bool one_word = line.find(' ', line.find_first_not_of(' ')) == std::string::npos ||
                            line.find('\'') != std::string::npos;
      EXPECT_TRUE(line.size() <= static_cast<std::size_t>(width) || one_word) << width << ": " << line;
    }
    const auto examples = std::find(lines.begin(), lines.end(), "Examples:");
    ASSERT_NE(examples, lines.end());
    EXPECT_EQ(std::count_if(examples, lines.end(),
                            [](const std::string& l) { return l.starts_with("  common_probe "); }),
              2);
  }
}

TEST_F(Tool, HelpGroupsOptionsAndShowsDefaults) {
  const std::string help = probe({"-h"}, {"COLUMNS=90"}).out;
  EXPECT_LT(help.find("\nOptions:"), help.find("\nCommon options:"));
  EXPECT_NE(help.find("a number that does nothing [3]"), std::string::npos) << help;
  EXPECT_NE(help.find("--progress auto|always|never"), std::string::npos) << help;
}

TEST_F(Tool, OptionGroupsAreOptionsLikeAllOthers) {
  const std::string help = probe({"--help"}, {"COLUMNS=90"}).out;
  EXPECT_LT(help.find("\nOptions:"), help.find("\nLevers:")) << help;
  EXPECT_LT(help.find("\nLevers:"), help.find("\nCommon options:")) << help;
  EXPECT_NE(help.find("--side left|right"), std::string::npos) << help;
  EXPECT_NE(help.find("a side [right]"), std::string::npos) << help;
  EXPECT_NE(probe({"--shaer", "1"}).err.find("did you mean --share?"), std::string::npos);
  EXPECT_NE(probe({"--show", "--side", "left"}).out.find("side 0"), std::string::npos);
  ASSERT_EQ(probe({"-o", file("a"), "--side", "left", "--report", file("r.json")}).status, 0);
  const json options = json::parse(read_text(file("r.json")))["options"];
  EXPECT_EQ(options["side"], "left");
  EXPECT_TRUE(options.contains("share"));
}

TEST_F(Tool, ANumberIsFiniteAndInItsRangeAndAChoiceIsAName) {
  for (const char* share : {"nan", "-nan", "inf", "-0.1", "1.1", "", "0,5", "0x1", "1e999"}) {
    const Outcome o = probe({"--share", share});
    EXPECT_EQ(o.status, 2) << share;
    EXPECT_NE(o.err.find("is not a number from 0 to 1; see"), std::string::npos) << o.err;
  }
  for (const char* share : {"0", "1", "0.25", "1e-3"})
    EXPECT_EQ(probe({"--share", share}).status, 0) << share;
  for (const char* side : {"0", "1", "up", "", "LEFT"}) {
    const Outcome o = probe({"--side", side});
    EXPECT_EQ(o.status, 2) << side;
    EXPECT_NE(o.err.find("not in {left,right}; see"), std::string::npos) << o.err;
  }
}

TEST_F(Tool, HelpAndVersionAnswerWhateverElseIsWrong) {
  EXPECT_EQ(probe({"--nonsense", "--help"}).status, 0);
  const Outcome o = probe({"--level", "x", "--version"});
  EXPECT_EQ(o.status, 0);
  EXPECT_EQ(o.out, "common_probe " COPSE_VERSION "\n");
}

TEST_F(Tool, LimitsNamesThoseOfTheToolAndOfAllTools) {
  const std::string limits = probe({"--limits"}).out;
  EXPECT_NE(limits.find("levels of the probe"), std::string::npos);
  EXPECT_NE(limits.find("nesting of response files"), std::string::npos);
}

// --- usage

TEST_F(Tool, WrongUseIsOneLineWithAHintAndStatusTwo) {
  struct Case {
    std::vector<std::string> arguments;
    const char* message;
  };
  for (const Case& c :
       {Case{{"--reprot", "x"},
             "there is no option --reprot; did you mean --report? see `common_probe --help`"},
        Case{{"--zzzzzz"}, "there is no option --zzzzzz; see"}, Case{{"a", "b"}, "'b' is one too many"},
        Case{{"--level", "x"}, "--level: 'x' cannot be read as INT"}, Case{{"--level"}, "--level"},
        Case{{"--jobs", "0"}, "'0' is not a whole number from 1 to 4096"}, Case{{"--jobs", "1e3"}, "'1e3'"},
        Case{{"--seed", "-1"}, "'-1'"}, Case{{"--progress", "maybe"}, "--progress"},
        Case{{"-q", "-v"}, "--quiet"}}) {
    const Outcome o = probe(c.arguments);
    EXPECT_EQ(o.status, 2) << o.err;
    EXPECT_EQ(line_count(o.err), 1u) << o.err;
    EXPECT_TRUE(o.err.starts_with("common_probe: error: ")) << o.err;
    EXPECT_NE(o.err.find(c.message), std::string::npos) << o.err;
    EXPECT_EQ(o.out, "");
  }
}

TEST_F(Tool, TheLastOfAnOptionGivenTwiceCounts) {
  EXPECT_EQ(probe({"-q", "--show", "--level", "1", "--level", "2"}).out,
            probe({"-q", "--show", "--level", "2"}).out);
}

// --- response and configuration files

TEST_F(Tool, ResponseFilesNestAndQuote) {
  write_text(file("inner"), "--text 'two words'");
  write_text(file("outer"), std::string("--show\n--level 9 @") + file("inner"));
  const Outcome o = probe({std::string("@") + file("outer"), "-q"});
  EXPECT_EQ(o.status, 0) << o.err;
  EXPECT_NE(o.out.find("level 9 text two words"), std::string::npos) << o.out;
  EXPECT_EQ(probe({std::string("@") + file("none")}).status, 3);
}

TEST_F(Tool, TheCommandLineWinsOverTheConfigurationFile) {
  write_text(file("c.toml"),
             "# settings\nlevel = 5\ntext = \"from the file\"\nseed = 18446744073709551615\nshow = true\n");
  EXPECT_NE(probe({"--config", file("c.toml"), "-q"})
                .out.find("seed 18446744073709551615 level 5 text from the file"),
            std::string::npos);
  EXPECT_NE(probe({"--level", "6", "--config", file("c.toml"), "-q"}).out.find("level 6 text from the file"),
            std::string::npos);
}

TEST_F(Tool, AConfigurationFileThatIsMissingOrWrongIsRefused) {
  EXPECT_EQ(probe({"--config", file("none.toml")}).status, 3);
  write_text(file("c.toml"), "levle = 5\n");
  const Outcome o = probe({"--config", file("c.toml")});
  EXPECT_EQ(o.status, 2);
  EXPECT_NE(o.err.find("c.toml: there is no option 'levle'"), std::string::npos) << o.err;
  EXPECT_EQ(line_count(o.err), 1u);
}

TEST_F(Tool, AConfigurationFileWithoutEndIsRefused) {
  write_text(file("big.toml"), "# " + std::string((1 << 20) + 1, 'x') + "\nlevel = 5\n");
  for (const std::string& config : {std::string("/dev/zero"), file("big.toml")}) {
    const Outcome o = probe({"--config", config});
    EXPECT_EQ(o.status, 2);
    EXPECT_NE(o.err.find(config), std::string::npos) << o.err;
    EXPECT_EQ(line_count(o.err), 1u);
  }
}

// --- exit statuses

TEST_F(Tool, EveryFaultHasItsStatusAndOneLine) {
  for (const auto& [fault, status] :
       {std::pair{"refused", 1}, {"memory", 1}, {"limit", 4}, {"throw", 70}, {"int", 70}}) {
    const Outcome o = probe({"-q", "--fault", fault});
    EXPECT_EQ(o.status, status) << fault;
    EXPECT_EQ(line_count(o.err), 1u) << o.err;
    EXPECT_NE(o.err.find("; "), std::string::npos) << "no remedy: " << o.err;
  }
  EXPECT_EQ(probe({"-q", "--fault", "refused"}).err,
            "common_probe: error: in.obj: line 3: no\\nsense; mend it\n");
}

TEST_F(Tool, WhatFailsLeavesNothing) {
  for (const char* fault : {"refused", "memory", "throw", "int"}) {
    probe({"-o", file("out"), "--report", file("r.json"), "--html", file("r.html"), "--depfile", file("d"),
           "--fault", fault});
    EXPECT_EQ(files(), 0u) << fault;
  }
}

TEST_F(Tool, ALimitThatIsNotMetLeavesReportAndPageWhichSayWhy) {
  const Outcome o = probe({"-q", "-o", file("out"), "--report", file("r.json"), "--html", file("r.html"),
                           "--depfile", file("d"), "--fault", "limit"});
  EXPECT_EQ(o.status, 4);
  EXPECT_EQ(line_count(o.err), 1u);
  EXPECT_EQ(files(), 2u);
  const json r = json::parse(read_text(file("r.json")));
  EXPECT_TRUE(r["outputs"].empty());
  EXPECT_NE(r["warnings"].back().get<std::string>().find("error 0.2 exceeds 0.1"), std::string::npos);
  EXPECT_NE(read_text(file("r.html")).find("nothing was written"), std::string::npos);
  EXPECT_EQ(json::parse(probe({"-q", "-o", file("out"), "--report", "-", "--fault", "limit"}).out)["tool"],
            "common_probe");
}

TEST_F(Tool, WhatFailsLeavesTheOldFileAsItWas) {
  write_text(file("out"), "old");
  probe({"-o", file("out"), "--fault", "limit"});
  EXPECT_EQ(read_text(file("out")), "old");
}

// --- outputs

TEST_F(Tool, AllOutputsAppearOnSuccess) {
  write_text(file("in.obj"), "v 0 0 0\n");
  const Outcome o = probe({file("in.obj"), "-o", file("out"), "--report", file("r.json"), "--html",
                           file("r.html"), "--depfile", file("d"), "-j", "3", "--seed", "7"});
  EXPECT_EQ(o.status, 0) << o.err;
  EXPECT_EQ(o.out, "");
  EXPECT_EQ(files(), 5u);
  EXPECT_EQ(read_text(file("out")), "probe\n");
  const json r = json::parse(read_text(file("r.json")));
  EXPECT_EQ(r["schema"], "copse.report/1");
  EXPECT_EQ(r["tool"], "common_probe");
  EXPECT_EQ(r["inputs"][0]["bytes"], 8);
  EXPECT_EQ(r["inputs"][0]["hash"].get<std::string>().substr(0, 5), "xxh3:");
  EXPECT_EQ(r["outputs"][0]["path"], file("out"));
  EXPECT_EQ(r["options"]["jobs"], "3");
  EXPECT_EQ(r["options"]["seed"], "7");
  EXPECT_EQ(r["options"]["level"], "3");
  EXPECT_EQ(r["stages"][0]["items"], 100);
  EXPECT_EQ(r["warnings"][0], "this is\na probe");
  EXPECT_GT(r["peak_bytes"].get<double>(), 1e5);
  EXPECT_NE(read_text(file("r.html")).find("<h1>in.obj</h1>"), std::string::npos);
  EXPECT_TRUE(read_text(file("d")).starts_with(file("out") + ": \\\n  " + file("in.obj")));
}

TEST_F(Tool, TheMemoryOfAReportIsNotThatOfWhatStartedTheTool) {
  const std::vector<char> large(std::size_t{600} << 20, 1);
  ASSERT_EQ(probe({"-q", "-o", file("out"), "--report", file("r.json")}).status, 0);
  EXPECT_LT(json::parse(read_text(file("r.json")))["peak_bytes"].get<double>(), 0.75 * double(large.size()));
}

TEST_F(Tool, ADashIsStdout) {
  EXPECT_EQ(probe({"-q", "-o", "-"}).out, "probe\n");
  EXPECT_EQ(json::parse(probe({"-q", "--report", "-"}).out)["tool"], "common_probe");
  EXPECT_EQ(probe({"-q", "-o", "-", "--fault", "limit"}).out, "");
}

TEST_F(Tool, WhatCannotBeWrittenIsAnIoErrorAndLeavesNothing) {
  write_text(file("f"), "");
  for (const std::string& path :
       {std::string("/dev/full"), file("none/out"), file("f/out"), folder_.path().string()}) {
    for (const char* option : {"-o", "--report", "--html", "--depfile"}) {
      const Outcome o = probe({"-q", option, path});
      EXPECT_EQ(o.status, 3) << option << " " << path << " " << o.err;
      EXPECT_EQ(line_count(o.err), 1u) << o.err;
    }
  }
  EXPECT_EQ(files(), 1u);
  // One output that fails takes the others with it.
  EXPECT_EQ(probe({"-q", "-o", file("out"), "--report", file("none/r.json")}).status, 3);
  EXPECT_EQ(files(), 1u);
}

TEST_F(Tool, AReportThatCannotBeWrittenIsFoundBeforeTheWork) {
  EXPECT_LT(probe({"-q", "--wait", "2", "--report", file("none/r.json")}).seconds, 1.5);
}

TEST_F(Tool, AClosedOrFullStdoutIsAnIoError) {
  for (const char* command : {"%P -q -o - >&-", "%P -q -o - >/dev/full", "%P -q --print >/dev/full",
                              "%P --help >/dev/full", "%P --version >&-"}) {
    const Outcome o = shell(command);
    EXPECT_EQ(o.status, 3) << command;
    EXPECT_EQ(line_count(o.err), 1u) << command << o.err;
  }
}

TEST_F(Tool, AReaderThatLeavesIsAnIoErrorNotASignal) {
  shell("{ %P -q --wait 0.3 -o -; echo $? >%D/status; } | true");
  for (int i = 0; i < 100 && !fs::exists(file("status")); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_EQ(read_text(file("status")), "3\n");
}

TEST_F(Tool, AClosedStderrDoesNotReachTheOutput) {
  shell("%P -o %D/out 2>&-");
  EXPECT_EQ(read_text(file("out")), "probe\n");
}

TEST_F(Tool, AnInputIsNeverOverwrittenUnlessItIsAContainer) {
  write_text(file("in.obj"), "v 0 0 0\n");
  fs::create_symlink(file("in.obj"), file("link.obj"));
  EXPECT_EQ(probe({file("in.obj"), "-o", file("in.obj")}).status, 2);
  EXPECT_EQ(probe({file("in.obj"), "-o", file("link.obj")}).status, 2);
  EXPECT_EQ(probe({file("in.obj"), "--report", file("in.obj")}).status, 2);
  EXPECT_EQ(read_text(file("in.obj")), "v 0 0 0\n");
  write_text(file("in.stree"), "tree");
  EXPECT_EQ(probe({file("in.stree"), "-o", file("in.stree")}).status, 0);
  EXPECT_EQ(read_text(file("in.stree")), "probe\n");
}

TEST_F(Tool, TwoOutputsMayNotShareAName) {
  EXPECT_EQ(probe({"--report", file("x"), "--html", file("x")}).status, 2);
  EXPECT_EQ(probe({"-o", file("x"), "--report", file("x")}).status, 2);
  EXPECT_EQ(files(), 0u);
}

// --- depfiles, as make and ninja read them

TEST_F(Tool, ANameThatNoDepfileHoldsIsRefusedBeforeAnythingIsWritten) {
  EXPECT_EQ(probe({"-o", file("a\nb"), "--depfile", file("d")}).status, 2);
  EXPECT_EQ(probe({"-o", file("out"), "--depfile", file("d\ne")}).status, 2);
  EXPECT_EQ(files(), 0u);
}

TEST_F(Tool, MakeReadsTheDepfileWhateverTheNames) {
  write_text(file("in $x #1.obj"), "v 0 0 0\n");
  ASSERT_EQ(shell("cd %D && %P -q 'in $x #1.obj' -o out --depfile out.d").status, 0);
  write_text(file("Makefile"), "out:\n\t@echo rebuilt\ninclude out.d\n");
  EXPECT_EQ(shell("cd %D && make -q out").status, 0);
  EXPECT_EQ(shell("cd %D && touch -d 'now + 1 hour' 'in $x #1.obj' && make out").out, "rebuilt\n");
  EXPECT_EQ(shell("cd %D && rm 'in $x #1.obj' && make out").status, 0);  // a file that is gone stops nothing
}

TEST_F(Tool, NinjaReadsTheDepfileWhateverTheNames) {
  write_text(file("in $x #1.obj"), "v 0 0 0\n");
  write_text(file("build.sh"),
             std::string(COPSE_BIN_DIR) + "/common_probe -q 'in $x #1.obj' -o out --depfile out.d\n");
  write_text(file("build.ninja"),
             "rule probe\n  command = sh build.sh\n  depfile = out.d\nbuild out: probe\n");
  ASSERT_EQ(shell("cd %D && ninja").status, 0);
  EXPECT_NE(shell("cd %D && ninja").out.find("no work to do"), std::string::npos);
  EXPECT_EQ(shell("cd %D && touch -d 'now + 1 hour' 'in $x #1.obj' && ninja -n").out.find("no work to do"),
            std::string::npos);
}

TEST_F(Tool, TheDepfileNamesResponseAndConfigurationFiles) {
  write_text(file("a.rsp"), "--level 4");
  write_text(file("c.toml"), "level = 5\n");
  ASSERT_EQ(probe({std::string("@") + file("a.rsp"), "--config", file("c.toml"), "-o", file("out"),
                   "--depfile", file("d"), "-q"})
                .status,
            0);
  const std::string depfile = read_text(file("d"));
  EXPECT_NE(depfile.find(file("a.rsp")), std::string::npos) << depfile;
  EXPECT_NE(depfile.find(file("c.toml")), std::string::npos) << depfile;
}

// --- console

TEST_F(Tool, QuietVerboseAndProgressSayWhatTheyShould) {
  EXPECT_EQ(probe({}).err, "common_probe: warning: this is\\na probe\n");
  EXPECT_EQ(probe({"-q"}).err, "");
  EXPECT_EQ(lines_of(probe({"-v"}).err)[0].substr(0, 20), "common_probe: wait: ");
  EXPECT_EQ(probe({"-q", "--wait", "1.2"}).err, "");  // no terminal, no bar
}

TEST_F(Tool, TheBarAppearsAfterASecondAndIsClearedAtTheEnd) {
  EXPECT_EQ(probe({"-q", "--progress", "always", "--wait", "0.2"}).err, "");
  const std::string bar = probe({"-q", "--progress", "always", "--wait", "1.5"}, {"COLUMNS=60"}).err;
  EXPECT_NE(bar.find("common_probe: wait [####"), std::string::npos) << bar;
  EXPECT_TRUE(bar.ends_with("\r\x1b[K")) << bar;
  EXPECT_EQ(bar.find('\n'), std::string::npos);
}

// --- threads

TEST_F(Tool, JobsFollowTheCommandLineTheAffinityAndTheBatchSystem) {
  EXPECT_NE(probe({"-q", "--show", "-j", "3"}).out.find("jobs 3 "), std::string::npos);
  EXPECT_NE(probe({"-q", "--show"}, {"SLURM_CPUS_PER_TASK=1"}).out.find("jobs 1 "), std::string::npos);
  EXPECT_NE(shell("taskset -c 0 %P -q --show").out.find("jobs 1 "), std::string::npos);
}

// --- signals

// Starts the probe, waits until its output is staged, sends the signal; the status as wait() gives it.
int status_after_signal(const fs::path& folder, const std::string& output, int signal) {
  const pid_t child = ::fork();
  if (child == 0) {
    const std::string program = std::string(COPSE_BIN_DIR) + "/common_probe";
    ::execl(program.c_str(), program.c_str(), "-q", "-o", output.c_str(), "--keep", nullptr);
    ::_exit(127);
  }
  for (int i = 0; i < 500 && fs::is_empty(folder); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_FALSE(fs::is_empty(folder)) << "nothing was staged";
  ::kill(child, signal);
  int status = 0;
  ::waitpid(child, &status, 0);
  return status;
}

TEST_F(Tool, ASignalLeavesNoTemporaryFileAndStillKills) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const int status = status_after_signal(folder_.path(), file("out"), signal);
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == signal) << status;
    EXPECT_EQ(files(), 0u);
  }
}

TEST_F(Tool, AnIgnoredSignalStaysIgnored) {
  const Outcome o = shell("trap '' INT; %P -q --wait 0.5 -o %D/out & sleep 0.2; kill -INT $!; wait $!");
  EXPECT_EQ(o.status, 0);
  EXPECT_EQ(read_text(file("out")), "probe\n");
}

}  // namespace
}  // namespace copse
