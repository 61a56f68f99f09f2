#include "shoal/core/calendar.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

#include "shoal/core/error.hpp"

namespace shoal {
namespace {

double days_between(const char* from, const char* to, Calendar calendar) {
  return parse_instant(to, calendar).since(parse_instant(from, calendar)) / 86400.0;
}

std::string later(const char* date, double days, Calendar calendar) {
  return iso_text(parse_instant(date, calendar).plus(days * 86400.0), calendar);
}

constexpr Calendar all_calendars[] = {Calendar::standard, Calendar::proleptic_gregorian,
                                      Calendar::julian,   Calendar::noleap,
                                      Calendar::all_leap, Calendar::days_360};

TEST(Calendars, CountTheDaysOfAnOrdinaryYear) {
  EXPECT_EQ(days_between("1970-01-01", "2014-12-01", Calendar::standard), 16405.0);
  EXPECT_EQ(days_between("1970-01-01", "2014-12-01", Calendar::proleptic_gregorian), 16405.0);
  EXPECT_EQ(days_between("2014-01-01", "2015-01-01", Calendar::noleap), 365.0);
  EXPECT_EQ(days_between("2014-01-01", "2015-01-01", Calendar::all_leap), 366.0);
  EXPECT_EQ(days_between("2014-01-01", "2015-01-01", Calendar::days_360), 360.0);
}

TEST(Calendars, DifferInTheirLeapYears) {
  EXPECT_EQ(later("2012-02-28", 1, Calendar::standard), "2012-02-29T00:00:00Z");
  EXPECT_EQ(later("2012-02-28", 1, Calendar::noleap), "2012-03-01T00:00:00Z");
  EXPECT_EQ(later("2013-02-28", 1, Calendar::all_leap), "2013-02-29T00:00:00Z");
  EXPECT_EQ(later("2013-02-28", 2, Calendar::days_360), "2013-02-30T00:00:00Z");
  EXPECT_EQ(later("1900-02-28", 1, Calendar::standard), "1900-03-01T00:00:00Z");
  EXPECT_EQ(later("1900-02-28", 1, Calendar::julian), "1900-02-29T00:00:00Z");
}

TEST(StandardCalendar, LeavesOutTenDaysOfOctober1582) {
  EXPECT_EQ(days_between("1582-10-04", "1582-10-15", Calendar::standard), 1.0);
  EXPECT_EQ(days_between("1582-10-04", "1582-10-15", Calendar::proleptic_gregorian), 11.0);
  EXPECT_EQ(later("1582-10-04", 1, Calendar::standard), "1582-10-15T00:00:00Z");
  EXPECT_EQ(later("1582-10-15", -1, Calendar::standard), "1582-10-04T00:00:00Z");
  EXPECT_EQ(later("1582-10-04", 18, Calendar::standard), "1582-11-01T00:00:00Z");
  EXPECT_THROW(parse_instant("1582-10-10", Calendar::standard), InputError);
  EXPECT_NO_THROW(parse_instant("1582-10-10", Calendar::julian));
  // The day number of astronomers: the Julian day of 2000-01-01 12:00 is 2451545.
  EXPECT_EQ(days_between("0001-01-01", "2000-01-01", Calendar::standard), 2451544.5 - 1721423.5);
}

TEST(Calendars, GiveBackEveryDayTheyCount) {
  for (const Calendar calendar : all_calendars) {
    EXPECT_TRUE(rc::check("a date read from its own text is the same day", [calendar] {
      const Instant day{*rc::gen::inRange<std::int64_t>(1000, 1'500'000), 0.0};
      RC_ASSERT(parse_instant(iso_text(day, calendar), calendar).since(day) == 0.0);
    }));
  }
}

TEST(Dates, AreReadInTheFormsOfCfAndIso) {
  const auto read = [](const char* text) {
    return iso_text(parse_instant(text, Calendar::standard), Calendar::standard);
  };
  EXPECT_EQ(read("2014-12-01T05:03:20Z"), "2014-12-01T05:03:20Z");
  EXPECT_EQ(read("1950-1-1"), "1950-01-01T00:00:00Z");
  EXPECT_EQ(read("1950-01-01 00:00:00.0"), "1950-01-01T00:00:00Z");
  EXPECT_EQ(read("1970-01-01 00:00:00 UTC"), "1970-01-01T00:00:00Z");
  EXPECT_EQ(read("2000-01-01 6:30"), "2000-01-01T06:30:00Z");
}

TEST(Dates, AreTakenBackToUtc) {
  const auto read = [](const char* text) {
    return iso_text(parse_instant(text, Calendar::standard), Calendar::standard);
  };
  EXPECT_EQ(read("1992-10-8 15:15:42.5 -6:00"), "1992-10-08T21:15:42.500Z");
  EXPECT_EQ(read("2014-12-01T01:00:00+05:30"), "2014-11-30T19:30:00Z");
  EXPECT_EQ(read("2014-12-01 00:00:00 +0200"), "2014-11-30T22:00:00Z");
  EXPECT_EQ(read("2014-12-01 00:00:00 -3"), "2014-12-01T03:00:00Z");
}

TEST(Dates, ThatDoNotExistAreRefused) {
  for (const char* text :
       {"", "yesterday", "2014-13-01", "2014-02-29", "2014-12-00", "2014-12", "2014-12-01 25:00",
        "2014-12-01 00:61", "2014-12-01T00:00:00 here", "0000-01-01", "2014-12-01x"}) {
    EXPECT_THROW(parse_instant(text, Calendar::standard), InputError) << text;
  }
  EXPECT_THROW(parse_instant("2012-02-29", Calendar::noleap), InputError);
  EXPECT_THROW(parse_instant("2012-01-31", Calendar::days_360), InputError);
}

TEST(Dates, AreThoseOfYearsWithFourDigits) {
  for (const Calendar calendar : all_calendars) {
    EXPECT_EQ(later("9999-12-29", 1, calendar), "9999-12-30T00:00:00Z");
    EXPECT_THROW(parse_instant("10000-01-01", calendar), InputError);
    const Instant last = parse_instant("9999-12-29", calendar);
    EXPECT_NO_THROW(require_date(last, calendar));
    EXPECT_THROW(require_date(last.plus(10 * 86400.0), calendar), InputError);
    for (const double seconds : {1e15, -1e15, 1e300, std::nan(""), HUGE_VAL}) {
      EXPECT_THROW(parse_instant("2014-12-01", calendar).plus(seconds), InputError) << seconds;
    }
  }
}

TEST(TimeUnits, AreThoseOfFixedLength) {
  const auto seconds = [](const std::string& unit) {
    return parse_time_units(unit + " since 2014-12-01", Calendar::standard).seconds;
  };
  EXPECT_EQ(seconds("seconds"), 1.0);
  EXPECT_EQ(seconds("Minutes"), 60.0);
  EXPECT_EQ(seconds("hours"), 3600.0);
  EXPECT_EQ(seconds("day"), 86400.0);
  EXPECT_EQ(seconds("weeks"), 604800.0);
  EXPECT_THROW(seconds("months"), InputError);
  EXPECT_THROW(seconds("years"), InputError);
  EXPECT_THROW(seconds("fortnights"), InputError);
  EXPECT_THROW(parse_time_units("seconds", Calendar::standard), InputError);
}

TEST(Calendars, OfUnknownNameAreRefused) {
  EXPECT_EQ(calendar_named("gregorian"), Calendar::standard);
  EXPECT_EQ(calendar_named("365_day"), Calendar::noleap);
  EXPECT_THROW(calendar_named("mayan"), InputError);
  EXPECT_THROW(calendar_named("none"), InputError);
}

}  // namespace
}  // namespace shoal
