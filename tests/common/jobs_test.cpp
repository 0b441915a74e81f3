#include "tools/common/jobs.h"

#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

namespace copse {
namespace {

namespace fs = std::filesystem;

// A file system root of its own, with the files that a kernel would show.
class Cgroup : public testing::Test {
 protected:
  void SetUp() override {
    root_ = fs::temp_directory_path() / (std::string("copse_cgroup_") + std::to_string(::getpid()));
    fs::create_directories(root_ / "proc/self");
  }
  void TearDown() override { fs::remove_all(root_); }
  void file(const std::string& name, const std::string& text) const {
    fs::create_directories((root_ / name).parent_path());
    std::ofstream(root_ / name) << text << "\n";
  }
  fs::path root_;
};

TEST_F(Cgroup, WithoutQuotaSaysNothing) {
  EXPECT_EQ(cgroup_cpus(root_), 0);
  file("proc/self/cgroup", "0::/user");
  file("sys/fs/cgroup/user/cpu.max", "max 100000");
  EXPECT_EQ(cgroup_cpus(root_), 0);
}

TEST_F(Cgroup, Version2TakesTheSmallestQuotaOnTheWayUp) {
  file("proc/self/cgroup", "0::/batch/job/task");
  file("sys/fs/cgroup/batch/cpu.max", "800000 100000");
  file("sys/fs/cgroup/batch/job/cpu.max", "250000 100000");
  file("sys/fs/cgroup/batch/job/task/cpu.max", "max 100000");
  EXPECT_EQ(cgroup_cpus(root_), 3);  // 2.5, rounded up
}

TEST_F(Cgroup, Version2InsideAContainerHasTheQuotaAtTheMount) {
  file("proc/self/cgroup", "0::/");
  file("sys/fs/cgroup/cpu.max", "50000 100000");
  EXPECT_EQ(cgroup_cpus(root_), 1);
}

TEST_F(Cgroup, Version1IsReadFromItsController) {
  file("proc/self/cgroup", "5:memory:/m\n4:cpu,cpuacct:/docker/abc");
  file("sys/fs/cgroup/cpu,cpuacct/docker/abc/cpu.cfs_quota_us", "400000");
  file("sys/fs/cgroup/cpu,cpuacct/docker/abc/cpu.cfs_period_us", "100000");
  EXPECT_EQ(cgroup_cpus(root_), 4);
  file("sys/fs/cgroup/cpu,cpuacct/docker/abc/cpu.cfs_quota_us", "-1");
  EXPECT_EQ(cgroup_cpus(root_), 0);
}

TEST_F(Cgroup, NonsenseIsNoQuota) {
  file("proc/self/cgroup", "::::\nnothing\n0::/x");
  file("sys/fs/cgroup/x/cpu.max", "lots");
  EXPECT_EQ(cgroup_cpus(root_), 0);
  file("sys/fs/cgroup/x/cpu.max", "100 0");
  EXPECT_EQ(cgroup_cpus(root_), 0);
}

TEST(Jobs, SlurmSaysAPositiveWholeNumberOrNothing) {
  EXPECT_EQ(slurm_cpus("16"), 16);
  for (const char* text : {"", "0", "-3", "4x", "x", "99999999999"}) EXPECT_EQ(slurm_cpus(text), 0) << text;
  EXPECT_EQ(slurm_cpus(nullptr), 0);
}

TEST(Jobs, TheDefaultIsAtMostTheAffinityMask) {
  EXPECT_GE(default_jobs(), 1);
  EXPECT_LE(default_jobs(), affinity_cpus());
}

}  // namespace
}  // namespace copse
