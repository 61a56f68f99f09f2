#include "shoal/core/calendar.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <vector>

#include "shoal/core/error.hpp"
#include "shoal/core/lower_case.hpp"
#include "shoal/core/text.hpp"

namespace shoal {
namespace {

constexpr double seconds_per_day = 86400.0;
constexpr std::int64_t last_year = 9999;               // ISO 8601 writes years with four digits
constexpr double most_days = 366.0 * (last_year + 1);  // of the calendar with the longest years

struct Date {
  std::int64_t year = 1;
  std::int64_t month = 1;
  std::int64_t day = 1;

  auto operator<=>(const Date&) const = default;
};

constexpr Date last_julian{1582, 10, 4};
constexpr Date first_gregorian{1582, 10, 15};

std::int64_t floor_divide(std::int64_t a, std::int64_t b) {
  return a / b - (a % b != 0 && (a < 0) != (b < 0));
}

bool is_gregorian(const Date& date, Calendar calendar) {
  return calendar == Calendar::proleptic_gregorian ||
         (calendar == Calendar::standard && date > last_julian);
}

bool is_leap(const Date& date, Calendar calendar) {
  if (calendar == Calendar::noleap) return false;
  if (calendar == Calendar::all_leap) return true;
  const bool fourth = date.year % 4 == 0;
  if (!is_gregorian(date, calendar)) return fourth;
  return fourth && (date.year % 100 != 0 || date.year % 400 == 0);
}

std::int64_t days_in_month(const Date& date, Calendar calendar) {
  if (calendar == Calendar::days_360) return 30;
  if (date.month == 2) return is_leap(date, calendar) ? 29 : 28;
  return date.month == 4 || date.month == 6 || date.month == 9 || date.month == 11 ? 30 : 31;
}

/// Days before the month in a year that begins with March, so that leap days come last.
std::int64_t days_before_month_from_march(std::int64_t month) {
  return (153 * ((month + 9) % 12) + 2) / 5;
}

std::int64_t day_number(const Date& date, Calendar calendar) {
  if (calendar == Calendar::days_360) {
    return 360 * date.year + 30 * (date.month - 1) + date.day - 1;
  }
  if (calendar == Calendar::noleap || calendar == Calendar::all_leap) {
    std::int64_t days = (calendar == Calendar::noleap ? 365 : 366) * date.year + date.day - 1;
    for (std::int64_t m = 1; m < date.month; ++m)
      days += days_in_month({date.year, m, 1}, calendar);
    return days;
  }
  const std::int64_t year = date.month > 2 ? date.year : date.year - 1;
  const std::int64_t days =
      365 * year + floor_divide(year, 4) + days_before_month_from_march(date.month) + date.day;
  // The two count alike from 200-03-01 to 300-02-28; so both run on through October 1582.
  return is_gregorian(date, calendar) ? days - floor_divide(year, 100) + floor_divide(year, 400)
                                      : days - 2;
}

Date date_of(std::int64_t day, Calendar calendar) {
  // The year is estimated from its mean length and put right; the month is found by counting.
  const double mean_year = calendar == Calendar::days_360   ? 360.0
                           : calendar == Calendar::noleap   ? 365.0
                           : calendar == Calendar::all_leap ? 366.0
                                                            : 365.2425;
  Date date{static_cast<std::int64_t>(std::floor(static_cast<double>(day) / mean_year)), 1, 1};
  while (day_number({date.year + 1, 1, 1}, calendar) <= day) ++date.year;
  while (day_number(date, calendar) > day) --date.year;
  while (date.month < 12 && day_number({date.year, date.month + 1, 1}, calendar) <= day) {
    ++date.month;
  }
  date.day += day - day_number(date, calendar);
  const bool in_october_1582 =
      calendar == Calendar::standard && date.year == 1582 && date.month == 10;
  if (in_october_1582 && date > last_julian) date.day += first_gregorian.day - last_julian.day - 1;
  return date;
}

/// Reads numbers and signs off the front of a text.
class Reader {
 public:
  explicit Reader(std::string_view text) : rest_(text) {}

  bool done() const { return rest_.empty(); }
  bool next_is(char c) const { return !rest_.empty() && rest_.front() == c; }
  bool next_is_digit() const {
    return !rest_.empty() && rest_.front() >= '0' && rest_.front() <= '9';
  }

  bool skip(char c) {
    if (!next_is(c)) return false;
    rest_.remove_prefix(1);
    return true;
  }

  bool skip_spaces() {
    const bool any = next_is(' ');
    while (skip(' ')) {
    }
    return any;
  }

  bool skip_word(std::string_view word) {
    if (!rest_.starts_with(word)) return false;
    rest_.remove_prefix(word.size());
    return true;
  }

  std::optional<std::int64_t> digits(std::size_t* count = nullptr) {
    std::int64_t number = 0;
    if (!next_is_digit()) return std::nullopt;
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), number);
    if (error != std::errc{}) return std::nullopt;
    if (count) *count = static_cast<std::size_t>(end - rest_.data());
    rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    return number;
  }

  std::optional<double> decimal() {
    double number = 0.0;
    if (!next_is_digit()) return std::nullopt;
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), number,
                                              std::chars_format::fixed);
    if (error != std::errc{}) return std::nullopt;
    rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    return number;
  }

 private:
  std::string_view rest_;
};

std::optional<Date> read_date(Reader& reader) {
  const auto year = reader.digits();
  if (!year || !reader.skip('-')) return std::nullopt;
  const auto month = reader.digits();
  if (!month || !reader.skip('-')) return std::nullopt;
  const auto day = reader.digits();
  if (!day) return std::nullopt;
  return Date{*year, *month, *day};
}

/// `h`, `h:m` or `h:m:s`, in seconds.
std::optional<double> read_clock(Reader& reader) {
  const auto hour = reader.digits();
  if (!hour || *hour > 24) return std::nullopt;
  double seconds = 3600.0 * static_cast<double>(*hour);
  if (reader.skip(':')) {
    const auto minute = reader.digits();
    if (!minute || *minute > 59) return std::nullopt;
    seconds += 60.0 * static_cast<double>(*minute);
    if (reader.skip(':')) {
      const auto second = reader.decimal();
      if (!second || *second >= 61.0) return std::nullopt;
      seconds += *second;
    }
  }
  if (seconds > seconds_per_day) return std::nullopt;
  return seconds;
}

/// `Z`, `UTC`, `GMT`, `+h`, `-hh`, `+hhmm`, `-h:mm`: seconds ahead of UTC.
std::optional<double> read_zone(Reader& reader) {
  if (reader.skip('Z') || reader.skip_word("UTC") || reader.skip_word("GMT")) {
    if (reader.done()) return 0.0;
  }
  double sign = 1.0;
  if (reader.skip('-')) {
    sign = -1.0;
  } else if (!reader.skip('+') && !reader.next_is_digit()) {
    return std::nullopt;
  }
  std::size_t width = 0;
  auto hours = reader.digits(&width);
  if (!hours) return std::nullopt;
  std::int64_t minutes = 0;
  if (width > 2) {
    minutes = *hours % 100;
    hours = *hours / 100;
  } else if (reader.skip(':')) {
    const auto given = reader.digits();
    if (!given) return std::nullopt;
    minutes = *given;
  }
  if (*hours > 14 || minutes > 59) return std::nullopt;
  return sign * static_cast<double>(*hours * 3600 + minutes * 60);
}

[[noreturn]] void refuse_date(std::string_view text, const std::string& why) {
  throw InputError("\"" + std::string(text) + "\" is no date" + why);
}

void require_real(const Date& date, Calendar calendar, std::string_view text) {
  const std::string in_calendar = " of the " + name_of(calendar) + " calendar";
  if (date.year > last_year) refuse_date(text, "; years end with " + std::to_string(last_year));
  if (date.month < 1 || date.month > 12 || date.day < 1 ||
      date.day > days_in_month(date, calendar)) {
    refuse_date(text, in_calendar);
  }
  if (calendar == Calendar::standard && date > last_julian && date < first_gregorian) {
    refuse_date(text, in_calendar + ", in which 1582-10-15 follows 1582-10-04");
  }
  if ((calendar == Calendar::standard || calendar == Calendar::julian) && date.year < 1) {
    refuse_date(text, in_calendar + ", which has no year 0");
  }
}

struct CalendarName {
  std::string_view name;
  Calendar calendar;
};

constexpr std::array<CalendarName, 9> calendar_names{
    {{"standard", Calendar::standard},
     {"gregorian", Calendar::standard},
     {"proleptic_gregorian", Calendar::proleptic_gregorian},
     {"julian", Calendar::julian},
     {"noleap", Calendar::noleap},
     {"365_day", Calendar::noleap},
     {"all_leap", Calendar::all_leap},
     {"366_day", Calendar::all_leap},
     {"360_day", Calendar::days_360}}};

std::string padded(std::int64_t number, std::size_t digits) {
  const std::string text = std::to_string(number);
  return std::string(text.size() < digits ? digits - text.size() : 0, '0') + text;
}

}  // namespace

Instant Instant::plus(double seconds) const {
  const double total = second + seconds;
  const double days = std::floor(total / seconds_per_day);
  if (!(std::abs(static_cast<double>(day) + days) <= most_days)) {
    throw InputError("a time of " + shortest(seconds) + " s is no date; years end with " +
                     std::to_string(last_year));
  }
  return {day + static_cast<std::int64_t>(days), total - days * seconds_per_day};
}

void require_date(const Instant& instant, Calendar calendar) {
  const Date date = date_of(instant.day, calendar);
  if (date.year >= 0 && date.year <= last_year) return;
  throw InputError("a time in the year " + std::to_string(date.year) + " is no date of the " +
                   name_of(calendar) + " calendar; years run from 0 to " +
                   std::to_string(last_year));
}

double Instant::since(const Instant& other) const {
  return static_cast<double>(day - other.day) * seconds_per_day + (second - other.second);
}

Calendar calendar_named(std::string_view name) {
  if (name.empty()) return Calendar::standard;
  for (const CalendarName& known : calendar_names) {
    if (known.name == lower_case(name)) return known.calendar;
  }
  std::vector<std::string> names;
  names.reserve(std::size(calendar_names));
  for (const CalendarName& known : calendar_names) names.emplace_back(known.name);
  throw InputError("the calendar \"" + std::string(name) + "\" is not one of " + listed(names));
}

std::string name_of(Calendar calendar) {
  for (const CalendarName& known : calendar_names) {
    if (known.calendar == calendar) return std::string(known.name);
  }
  return "?";
}

Instant parse_instant(std::string_view text, Calendar calendar) {
  Reader reader(trimmed(text));
  const auto date = read_date(reader);
  if (!date) refuse_date(text, "; write it like 2014-12-01T00:00:00Z");
  require_real(*date, calendar, text);
  double seconds = 0.0;
  if (!reader.done()) {
    const bool separated = reader.skip('T') || reader.skip_spaces() || reader.next_is('Z');
    if (!separated) refuse_date(text, "; write it like 2014-12-01T00:00:00Z");
    if (reader.next_is_digit()) {
      const auto clock = read_clock(reader);
      if (!clock) refuse_date(text, " with a time of day; write it like 2014-12-01T00:00:00Z");
      seconds = *clock;
    }
    reader.skip_spaces();
    if (!reader.done()) {
      const auto zone = read_zone(reader);
      if (!zone || !reader.done()) refuse_date(text, " with a time zone; write Z or +hh:mm");
      seconds -= *zone;
    }
  }
  return Instant{day_number(*date, calendar), 0.0}.plus(seconds);
}

std::string iso_text(const Instant& instant, Calendar calendar) {
  // Rounded to the millisecond first, so that 59.9999 s is not written as 60.
  const auto milliseconds = static_cast<std::int64_t>(std::llround(instant.second * 1000.0));
  const std::int64_t per_day = 86'400'000;
  const Date date = date_of(instant.day + milliseconds / per_day, calendar);
  const std::int64_t within = milliseconds % per_day;
  std::string text = padded(date.year, 4) + '-' + padded(date.month, 2) + '-' +
                     padded(date.day, 2) + 'T' + padded(within / 3'600'000, 2) + ':' +
                     padded(within / 60'000 % 60, 2) + ':' + padded(within / 1000 % 60, 2);
  if (within % 1000 != 0) text += '.' + padded(within % 1000, 3);
  return text + "Z";
}

bool looks_like_time_units(std::string_view units) {
  return lower_case(units).find(" since ") != std::string::npos;
}

TimeUnits parse_time_units(std::string_view units, Calendar calendar) {
  const std::string lowered = lower_case(units);
  const std::size_t since = lowered.find(" since ");
  if (since == std::string::npos) {
    throw InputError("the time units \"" + std::string(units) +
                     "\" are not of the form \"seconds since 2014-12-01 00:00:00\"");
  }
  const std::string unit(trimmed(std::string_view(lowered).substr(0, since)));
  static const std::vector<std::pair<std::vector<std::string>, double>> known{
      {{"millisecond", "milliseconds", "msec", "msecs", "ms"}, 1e-3},
      {{"second", "seconds", "sec", "secs", "s"}, 1.0},
      {{"minute", "minutes", "min", "mins"}, 60.0},
      {{"hour", "hours", "hr", "hrs", "h"}, 3600.0},
      {{"day", "days", "d"}, seconds_per_day},
      {{"week", "weeks"}, 7.0 * seconds_per_day}};
  for (const auto& [spellings, seconds] : known) {
    for (const std::string& spelling : spellings) {
      if (unit == spelling) {
        return {seconds, parse_instant(units.substr(since + 7), calendar)};
      }
    }
  }
  throw InputError(
      "the time unit \"" + unit + "\" is not one of seconds, minutes, hours, days and weeks" +
      (unit.starts_with("month") || unit.starts_with("year") || unit.starts_with("common_year")
           ? "; the length of months and years is not defined, convert the file"
           : ""));
}

}  // namespace shoal
