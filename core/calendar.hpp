#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace shoal {

/// The calendars of the CF conventions (CF-1.8, sec. 4.4.1).
enum class Calendar {
  standard,  ///< Julian until 1582-10-04, Gregorian from 1582-10-15, nothing between
  proleptic_gregorian,
  julian,
  noleap,
  all_leap,
  days_360
};

/// A moment in some calendar: days since an epoch of that calendar, and seconds (UTC) of the day,
/// in [0, 86400). Kept apart because one double does not hold both exactly.
struct Instant {
  std::int64_t day = 0;
  double second = 0.0;

  /// Throws InputError for what is in no year of four digits of any calendar.
  Instant plus(double seconds) const;
  /// Seconds from `other` to here.
  double since(const Instant& other) const;
};

/// Throws InputError for what is in no year of four digits of this calendar.
void require_date(const Instant& instant, Calendar calendar);

/// The calendar of that CF name ("" means standard). Throws InputError for any other.
Calendar calendar_named(std::string_view name);
std::string name_of(Calendar calendar);

/// A date as CF and ISO 8601 write it: `2014-12-01T05:03:20Z`, `1992-10-8 15:15:42.5 -6:00`,
/// `1950-1-1`. A zone says how far its clock is ahead of UTC; without one the date is UTC.
/// Throws InputError for what is no date of this calendar.
Instant parse_instant(std::string_view text, Calendar calendar);

/// `2014-12-01T05:03:20Z`, with fractions of a second where there are some.
std::string iso_text(const Instant& instant, Calendar calendar);

/// CF time units, `seconds since 2014-12-01 00:00:00`.
struct TimeUnits {
  double seconds = 1.0;  ///< of one unit
  Instant reference;
};

/// Throws InputError; also for months and years, whose length CF leaves to the beholder.
TimeUnits parse_time_units(std::string_view units, Calendar calendar);

/// True for `<something> since <something>`.
bool looks_like_time_units(std::string_view units);

}  // namespace shoal
