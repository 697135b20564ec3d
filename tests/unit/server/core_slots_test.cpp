// SPDX-License-Identifier: GPL-3.0-or-later
// How the CPUs of a machine are divided among jobs.
#include "server/jobs/core_slots.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sched.h>

#include <memory>

namespace seaway::jobs {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Hardware threads as Linux numbers them: the second ones of all cores after the first ones.
std::vector<Cpu> machine(int cores, int threads_of_each) {
  std::vector<Cpu> out;
  for (int i = 0; i < cores * threads_of_each; ++i) out.push_back({i, "core" + std::to_string(i % cores)});
  return out;
}

/// What so many jobs get that run at the same time.
std::vector<std::vector<int>> taken(CoreSlots& slots, int jobs) {
  std::vector<std::unique_ptr<CoreSlots::Slot>> held;
  std::vector<std::vector<int>> out;
  for (int i = 0; i < jobs; ++i) {
    held.emplace_back(new CoreSlots::Slot(slots.take()));
    out.push_back(held.back()->cpus());
  }
  return out;
}

TEST(CoreSlots, EachJobHasItsOwnAndGivesThemBack) {
  CoreSlots slots(machine(4, 1), 2, 2);
  for (int round = 0; round < 2; ++round) EXPECT_THAT(taken(slots, 2), ElementsAre(ElementsAre(0, 1), ElementsAre(2, 3)));
  const CoreSlots::Slot first = slots.take();
  {
    const CoreSlots::Slot second = slots.take();
    EXPECT_THAT(second.cpus(), ElementsAre(2, 3));
  }
  EXPECT_THAT(slots.take().cpus(), ElementsAre(2, 3)) << "the first one is still in use";
}

TEST(CoreSlots, HardwareThreadsOfACoreBelongToOneJob) {
  CoreSlots roomy(machine(4, 2), 2, 2);
  EXPECT_THAT(taken(roomy, 2), ElementsAre(ElementsAre(0, 1), ElementsAre(2, 3))) << "a core for each thread";
  CoreSlots full(machine(4, 2), 2, 4);
  EXPECT_THAT(taken(full, 2), ElementsAre(ElementsAre(0, 4, 1, 5), ElementsAre(2, 6, 3, 7))) << "no core for two jobs";
}

TEST(CoreSlots, TooManyJobsShareEvenly) {
  CoreSlots slots(machine(2, 1), 4, 1);
  EXPECT_THAT(taken(slots, 4), ElementsAre(ElementsAre(0), ElementsAre(1), ElementsAre(0), ElementsAre(1)));
  CoreSlots odd(machine(3, 1), 2, 2);
  EXPECT_THAT(taken(odd, 2), ElementsAre(ElementsAre(0, 1), ElementsAre(2, 0)));
}

TEST(CoreSlots, AJobThatMayUseAllIsNotHeld) {
  CoreSlots one(machine(2, 1), 1, 2);
  EXPECT_THAT(one.take().cpus(), IsEmpty());
  CoreSlots more(machine(2, 1), 2, 8);
  EXPECT_THAT(more.take().cpus(), IsEmpty());
  CoreSlots unknown({}, 2, 1);
  EXPECT_THAT(unknown.take().cpus(), IsEmpty());
}

TEST(CoreSlots, AThreadKeepsToItsCpusForAWhile) {
  const auto own = available_cpus();
  ASSERT_FALSE(own.empty());
  {
    const KeepToCpus keep({own.back().number});
    EXPECT_TRUE(keep.is_kept());
    EXPECT_THAT(available_cpus(), ElementsAre(own.back()));
  }
  EXPECT_EQ(available_cpus(), own);
  const KeepToCpus gone({CPU_SETSIZE - 1});
  EXPECT_FALSE(gone.is_kept());
  EXPECT_EQ(available_cpus(), own);
}

}  // namespace
}  // namespace seaway::jobs
