#include "shoal/analysis/experiments/store/store.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <limits>
#include <stdexcept>

#include "shoal/analysis/experiments/store/stored_union.hpp"
#include "shoal/core/error.hpp"
#include "tests/support/nan_value.hpp"
#include "tests/support/scratch_folder.hpp"

namespace shoal::analysis {
namespace {

using shoal::tests::nan_value;
constexpr double infinity = std::numeric_limits<double>::infinity();

StoredTrial trial(const std::string& key) {
  return {.key = key,
          .group = "group",
          .factors = {{"behaviour", "rigid"}, {"period", "0.1"}},
          .replication = 3,
          .seed = 9000000000000004,
          .scenario = "a scenario",
          .id = "an id",
          .program = "0.1.0-abc",
          .failure = "",
          .wall_s = 0.125,
          .measures = {{"energy_wh", 0.1}, {"quality_m", std::nullopt}},
          .series = {}};
}

std::vector<std::uint64_t> bits(const std::vector<double>& numbers) {
  std::vector<std::uint64_t> all;
  for (const double x : numbers) all.push_back(std::bit_cast<std::uint64_t>(x));
  return all;
}

class StoreInAFolder : public testing::Test {
 protected:
  StoredTrial read(const std::string& key) const {
    const Store store(folder_.path(), Store::Access::read);
    StoredTrial found = store.find(key).value();
    found.series = store.series_of(key);
    return found;
  }
  void write(const StoredTrial& written) const {
    Store(folder_.path(), Store::Access::write).write(written);
  }

  tests::ScratchFolder folder_;
};

TEST_F(StoreInAFolder, GivesBackWhatWasWritten) {
  const StoredTrial written = trial("a");
  write(written);
  const StoredTrial found = read("a");
  EXPECT_EQ(found.key, written.key);
  EXPECT_EQ(found.group, written.group);
  EXPECT_EQ(found.factors, written.factors);
  EXPECT_EQ(found.replication, written.replication);
  EXPECT_EQ(found.seed, written.seed);
  EXPECT_EQ(found.scenario, written.scenario);
  EXPECT_EQ(found.id, written.id);
  EXPECT_EQ(found.program, written.program);
  EXPECT_FALSE(found.failed());
  EXPECT_EQ(found.wall_s, written.wall_s);
  EXPECT_EQ(found.measures, written.measures);
}

TEST_F(StoreInAFolder, KeepsEveryBitOfAMeasure) {
  const std::vector<double> numbers{0.1,
                                    1.0 / 3.0,
                                    -1e300,
                                    12345678901234567.0,
                                    5e-324,
                                    -0.0,
                                    infinity,
                                    -infinity,
                                    std::numeric_limits<double>::max()};
  StoredTrial written = trial("a");
  written.measures.clear();
  for (const double x : numbers) {
    written.measures.emplace_back("m" + std::to_string(written.measures.size()), x);
  }
  write(written);
  std::vector<double> found;
  for (const auto& [name, value] : read("a").measures) found.push_back(value.value());
  EXPECT_EQ(bits(found), bits(numbers));
}

TEST_F(StoreInAFolder, RefusesAMeasureThatIsNoNumber) {
  StoredTrial written = trial("a");
  written.measures = {{"energy_wh", nan_value}};
  EXPECT_THROW(write(written), std::logic_error);
  EXPECT_FALSE(Store(folder_.path(), Store::Access::read).find("a"));
}

TEST_F(StoreInAFolder, KeepsEveryBitOfASeriesAndItsUnit) {
  StoredTrial written = trial("a");
  written.series = {{"empty_m", "m", "nothing", {}, {}},
                    {"quality", "m", "how good", {0.0, 30.0, 1e9}, {-0.0, nan_value, infinity}}};
  write(written);
  const StoredTrial found = read("a");
  ASSERT_EQ(found.series.size(), 2u);
  EXPECT_TRUE(found.series[0].time_s.empty());
  EXPECT_EQ(found.series[1].name, "quality");
  EXPECT_EQ(found.series[1].unit, "m");
  EXPECT_EQ(found.series[1].meaning, "how good");
  EXPECT_EQ(bits(found.series[1].time_s), bits(written.series[1].time_s));
  EXPECT_EQ(bits(found.series[1].values), bits(written.series[1].values));

  const Store store(folder_.path(), Store::Access::read);
  EXPECT_EQ(store.series_names(), (std::vector<std::string>{"empty_m", "quality"}));
  EXPECT_EQ(store.keys_with_series("quality"), std::vector<std::string>{"a"});
  ASSERT_EQ(store.series("quality").size(), 1u);
  EXPECT_EQ(bits(store.series("quality")[0].second.values), bits(written.series[1].values));
}

TEST_F(StoreInAFolder, GrowsByTheFactorsAndMeasuresOfLaterTrials) {
  write(trial("a"));
  StoredTrial later = trial("b");
  later.factors = {{"behaviour", "rigid"}, {"lost \"ones\"", "5"}};
  later.measures = {{"order", 2.0}, {"energy_wh", 3.0}};  // SQL has a word of that name
  write(later);
  EXPECT_EQ(read("b").factors, later.factors);
  EXPECT_EQ(read("a").factors, trial("a").factors);
  const Store store(folder_.path(), Store::Access::read);
  EXPECT_EQ(store.measure_names(), (std::vector<std::string>{"energy_wh", "quality_m", "order"}));
  EXPECT_EQ(read("a").measures.back(),
            (std::pair<std::string, std::optional<double>>("order", {})));
}

TEST_F(StoreInAFolder, ReplacesATrialWithAllItsSeries) {
  StoredTrial written = trial("a");
  written.series = {{"quality", "m", "", {0.0}, {1.0}}, {"path_m", "m", "", {0.0}, {1.0}}};
  write(written);
  written.series.pop_back();
  written.failure = "it sank, \"slowly\"";
  written.measures = {{"energy_wh", 4.0}};
  write(written);
  const StoredTrial found = read("a");
  EXPECT_EQ(found.series.size(), 1u);
  EXPECT_EQ(found.failure, written.failure);
  EXPECT_EQ(found.measures[0].second, 4.0);
  EXPECT_EQ(found.measures[1].second, std::nullopt);
  EXPECT_EQ(Store(folder_.path(), Store::Access::read).trials().size(), 1u);
}

TEST_F(StoreInAFolder, ErasesATrialWithItsSeriesAndNoOther) {
  for (const char* key : {"a", "b", "c"}) {
    StoredTrial written = trial(key);
    written.series = {{"quality", "m", "", {0.0}, {1.0}}};
    write(written);
  }
  Store(folder_.path(), Store::Access::write).erase({"a", "c"});
  const Store store(folder_.path(), Store::Access::read);
  EXPECT_EQ(store.keys_with_series("quality"), std::vector<std::string>{"b"});
  EXPECT_EQ(store.trials().size(), 1u);
}

TEST_F(StoreInAFolder, StoresTogetherOrNotAtAll) {
  Store store(folder_.path(), Store::Access::write);
  EXPECT_THROW(store.together([&] {
    StoredTrial first = trial("a");
    first.measures.emplace_back("new_m", 1.0);
    store.write(first);
    throw std::runtime_error("cut short");
  }),
               std::runtime_error);
  EXPECT_TRUE(store.trials().empty());
  EXPECT_TRUE(store.measure_names().empty());
  // The columns that it had made are gone, too, and are made again.
  StoredTrial second = trial("b");
  second.measures.emplace_back("new_m", 2.0);
  store.write(second);
  EXPECT_EQ(store.find("b")->measures.back().second, 2.0);
}

TEST_F(StoreInAFolder, ReadsTheMeasuresThatAreAskedFor) {
  write(trial("a"));
  const Store store(folder_.path(), Store::Access::read);
  const StoredTrial found = store.trials(std::vector<std::string>{"no_such", "energy_wh"}).front();
  ASSERT_EQ(found.measures.size(), 2u);
  EXPECT_EQ(found.measures[0].second, std::nullopt);
  EXPECT_EQ(found.measures[1].second, 0.1);
}

TEST_F(StoreInAFolder, RefusesWhatIsNoStore) {
  EXPECT_THROW(Store(folder_.path(), Store::Access::read), InputError);
  folder_.write("trials.sqlite", "these are words, and not a data base, however long they go on");
  EXPECT_THROW(Store(folder_.path(), Store::Access::read), InputError);
  EXPECT_THROW(Store(folder_.path(), Store::Access::write), InputError);
}

TEST(Difference, IsNoneBetweenEqualTrialsHoweverLongTheyTook) {
  StoredTrial a = trial("a"), b = trial("a");
  b.wall_s = 100.0;
  b.measures = {{"quality_m", std::nullopt}, {"energy_wh", 0.1}, {"other_m", std::nullopt}};
  a.series = {{"quality", "m", "", {0.0, 1.0}, {nan_value, 1.0}}};
  EXPECT_EQ(difference(a, b), std::nullopt);  // one of them lacks the series
  b.series = a.series;
  EXPECT_EQ(difference(a, b), std::nullopt);
}

TEST(Difference, NamesWhatDiffers) {
  const StoredTrial a = trial("a");
  StoredTrial b = a;
  b.measures[0].second = 0.25;
  EXPECT_EQ(difference(a, b).value_or(""), "energy_wh is 0.1 in the first, and 0.25 in the second");
  b = a;
  b.measures[1].second = 0.0;
  EXPECT_EQ(difference(a, b).value_or(""), "quality_m is null in the first, and 0 in the second");
  b = a;
  b.seed = 5;
  EXPECT_NE(difference(a, b).value_or("").find("its seed is"), std::string::npos);
  b = a;
  b.failure = "it sank";
  EXPECT_EQ(difference(a, b).value_or(""),
            "it is done in the first, and failed (it sank) in the second");
}

TEST(Difference, SeesOneBitOfASeries) {
  StoredTrial a = trial("a");
  a.series = {{"quality", "m", "", {0.0, 1.0}, {0.0, 1.0}}};
  StoredTrial b = a;
  b.series[0].values[0] = -0.0;
  EXPECT_NE(difference(a, b), std::nullopt);
  b = a;
  b.series[0].time_s.pop_back();
  EXPECT_NE(difference(a, b), std::nullopt);
}

}  // namespace
}  // namespace shoal::analysis
