#include "shoal/analysis/statistics/survival.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace shoal::analysis::statistics {
namespace {

using Samples = std::vector<std::vector<EventTime>>;
constexpr double never = std::numeric_limits<double>::infinity();

// Remission of leukaemia, in weeks, with 6-mercaptopurine and with placebo (Freireich et al. 1963):
// the example of most textbooks.
const std::vector<EventTime> treated{
    {6},         {6},         {6},         {6, false},  {7},         {9, false},  {10},
    {10, false}, {11, false}, {13},        {16},        {17, false}, {19, false}, {20, false},
    {22},        {23},        {25, false}, {32, false}, {32, false}, {34, false}, {35, false}};
const std::vector<EventTime> placebo{{1}, {1}, {2},  {2},  {3},  {4},  {4},  {5},  {5},  {8}, {8},
                                     {8}, {8}, {11}, {11}, {12}, {12}, {15}, {17}, {22}, {23}};

TEST(KaplanMeier, IsTheProductOfTheSharesThatAreLeft) {
  const std::vector<SurvivalStep> steps = kaplan_meier(treated);
  ASSERT_EQ(steps.size(), 7u);
  EXPECT_EQ(steps[0].at_risk, 21);
  EXPECT_EQ(steps[0].events, 3);
  EXPECT_NEAR(steps[0].surviving, 18.0 / 21.0, 1e-15);
  EXPECT_NEAR(steps[1].surviving, 18.0 / 21.0 * 16.0 / 17.0, 1e-15);
  // Klein and Moeschberger 2003, table 4.1: 0.448 and a standard error of 0.135 at 23 weeks.
  EXPECT_NEAR(steps[6].surviving, 0.448, 5e-4);
  EXPECT_NEAR(std::sqrt(steps[6].variance), 0.135, 5e-4);
  EXPECT_TRUE(kaplan_meier({}).empty());
}

TEST(RestrictedMean, IsTheMeanOfTheLesserOfTimeAndHorizon) {
  const std::vector<EventTime> times{{1}, {3}, {5, false}, {5, false}};
  const auto result = restricted_mean(times, 4.0);
  ASSERT_TRUE(result);
  EXPECT_NEAR(result->mean, (1.0 + 3.0 + 4.0 + 4.0) / 4.0, 1e-15);
  EXPECT_NEAR(result->variance, (4.0 + 0.0 + 1.0 + 1.0) / 4.0 / 4.0, 1e-15);
  EXPECT_EQ(restricted_times(times, 4.0), (std::vector<double>{1, 3, 4, 4}));
  EXPECT_FALSE(restricted_mean(times, 6.0)) << "nothing is known beyond 5";
  EXPECT_THROW(restricted_times(times, 6.0), std::invalid_argument);
  EXPECT_FALSE(restricted_mean({}, 1.0));
}

TEST(RestrictedMean, IsThePlainMeanWhereAllReachedTheEvent) {
  const auto result = restricted_mean(placebo, never);
  ASSERT_TRUE(result);
  EXPECT_NEAR(result->mean, 182.0 / 21.0, 1e-13);
}

TEST(RestrictedTimes, AverageToTheRestrictedMeanWhereWatchesEndedEarly) {
  const double horizon = common_horizon(Samples{treated, placebo});
  EXPECT_EQ(horizon, 35.0);
  const std::vector<double> times = restricted_times(treated, horizon);
  EXPECT_NEAR(restricted_mean(treated, horizon)->mean, 23.287, 5e-4);  // R: survfit(), rmean = 35
  // Pseudo-values of a jackknife: unbiased up to terms of 1 / n.
  EXPECT_NEAR(mean(times), 23.287, 0.3);
}

TEST(CommonHorizon, IsThatOfTheShortestWatchThatNothingOutlasts) {
  EXPECT_EQ(common_horizon(Samples{placebo}), never);
  const std::vector<EventTime> ends_earlier{{1}, {20, false}};
  EXPECT_EQ(common_horizon(Samples{treated, ends_earlier}), 20.0);
}

TEST(LogRankTest, TellsTheTreatedFromTheOthers) {
  const auto result = log_rank(Samples{treated, placebo});
  ASSERT_TRUE(result);
  EXPECT_NEAR(result->chi_squared, 16.79, 0.005);  // Kleinbaum and Klein 2012, ch. 2
  EXPECT_EQ(result->degrees, 1);
  EXPECT_LT(result->p_value, 1e-4);
  const auto swapped = log_rank(Samples{placebo, treated});
  EXPECT_NEAR(swapped->chi_squared, result->chi_squared, 1e-12);
  const auto alike = log_rank(Samples{treated, treated});
  EXPECT_NEAR(alike->p_value, 1.0, 1e-7);
}

TEST(LogRankTest, HasNoAnswerWithoutEventsOrWithoutRivals) {
  const std::vector<EventTime> none{{5, false}, {5, false}};
  EXPECT_FALSE(log_rank(Samples{none, none}));
  EXPECT_FALSE(log_rank(Samples{treated}));
  EXPECT_FALSE(log_rank(Samples{treated, std::vector<EventTime>{}}));
  // One of each: the event of the one, while the other was watched.
  EXPECT_TRUE(log_rank(Samples{std::vector<EventTime>{{1}}, none}));
}

TEST(EventTimes, ThatAreNoTimesAreRefused) {
  EXPECT_THROW(kaplan_meier(std::vector<EventTime>{{-1.0}}), std::invalid_argument);
  EXPECT_THROW(log_rank(Samples{std::vector<EventTime>{{never}}}), std::invalid_argument);
}

}  // namespace
}  // namespace shoal::analysis::statistics
