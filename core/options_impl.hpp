#pragma once

// The typed half of options.hpp.

#include "shoal/core/options.hpp"
#include "shoal/core/text.hpp"

namespace shoal {

namespace detail {

/// `trial.seed is a string; it takes an integer`.
[[noreturn]] void refuse_type(const Option& option, const Setting& value, const std::string& key);
/// Also refuses values that are not finite.
void require_range(const Option& option, double x, const Setting& value, const std::string& key);

double as_number(const Option& option, const Setting& value, const std::string& key);
std::int64_t as_integer(const Option& option, const Setting& value, const std::string& key);
const std::string& as_text(const Option& option, const Setting& value, const std::string& key);
FilePath as_file(const Option& option, const Setting& value, const std::string& key);
Eigen::Vector2d as_point(const Option& option, const Setting& value, const std::string& key);
NamedNumbers as_named_numbers(const Option& option, const Setting& value, const std::string& key);
Setting::Table written(const NamedNumbers& numbers);
/// What each of named numbers is.
const Option& named_number();
const Setting::List& as_list(const Option& option, const Setting& value, const std::string& key);

template <class Value>
Setting plain(Value value) {
  Setting setting;
  setting.value = std::move(value);
  return setting;
}

}  // namespace detail

template <class T>
template <class Value, class Read, class Write>
void Options<T>::add(Option option, Value T::*member, Read read, Write write) {
  // The closures hold a copy of what they need to complain; the option itself may move.
  const Option described = option;
  option.read = [described, member, read](void* object, const Setting& value,
                                          const std::string& key) {
    static_cast<T*>(object)->*member = read(described, value, key);
  };
  option.write = [member, write](const void* object) {
    return detail::plain(write(static_cast<const T*>(object)->*member));
  };
  options_.push_back(std::move(option));
}

template <class T>
void Options<T>::number(std::string name, double T::*member, std::string unit, Range range,
                        std::string meaning) {
  add({.name = std::move(name),
       .unit = std::move(unit),
       .meaning = std::move(meaning),
       .type = "a number",
       .range = range},
      member, detail::as_number, [](double x) { return x; });
}

template <class T>
void Options<T>::integer(std::string name, std::int64_t T::*member, std::string unit, Range range,
                         std::string meaning) {
  add({.name = std::move(name),
       .unit = std::move(unit),
       .meaning = std::move(meaning),
       .type = "an integer",
       .range = range},
      member, detail::as_integer, [](std::int64_t x) { return x; });
}

template <class T>
void Options<T>::flag(std::string name, bool T::*member, std::string meaning) {
  add(
      {.name = std::move(name), .meaning = std::move(meaning), .type = "true or false"}, member,
      [](const Option& option, const Setting& value, const std::string& key) {
        const bool* flag = std::get_if<bool>(&value.value);
        if (!flag) detail::refuse_type(option, value, key);
        return *flag;
      },
      [](bool x) { return x; });
}

template <class T>
void Options<T>::text(std::string name, std::string T::*member, std::string meaning) {
  add({.name = std::move(name), .meaning = std::move(meaning), .type = "a string"}, member,
      detail::as_text, [](const std::string& x) { return x; });
}

template <class T>
void Options<T>::file(std::string name, FilePath T::*member, std::string meaning) {
  add({.name = std::move(name),
       .meaning = std::move(meaning),
       .type = "a file name",
       .is_file = true},
      member, detail::as_file, [](const FilePath& x) { return x.path.string(); });
}

template <class T>
void Options<T>::texts(std::string name, std::vector<std::string> T::*member, std::string meaning) {
  add(
      {.name = std::move(name), .meaning = std::move(meaning), .type = "a list of strings"}, member,
      [](const Option& option, const Setting& value, const std::string& key) {
        std::vector<std::string> texts;
        for (const Setting& entry : detail::as_list(option, value, key)) {
          texts.push_back(detail::as_text(option, entry, key));
        }
        return texts;
      },
      [](const std::vector<std::string>& texts) {
        Setting::List list;
        for (const std::string& text : texts) list.push_back(detail::plain(text));
        return list;
      });
}

template <class T>
void Options<T>::numbers(std::string name, std::vector<double> T::*member, std::string unit,
                         Range range, std::string meaning) {
  add(
      {.name = std::move(name),
       .unit = std::move(unit),
       .meaning = std::move(meaning),
       .type = "a list of numbers",
       .range = range},
      member,
      [](const Option& option, const Setting& value, const std::string& key) {
        std::vector<double> numbers;
        for (const Setting& entry : detail::as_list(option, value, key)) {
          numbers.push_back(detail::as_number(option, entry, key));
        }
        return numbers;
      },
      [](const std::vector<double>& numbers) {
        Setting::List list;
        for (const double number : numbers) list.push_back(detail::plain(number));
        return list;
      });
}

template <class T>
void Options<T>::named_numbers(std::string name, NamedNumbers T::*member, std::string meaning) {
  add({.name = std::move(name),
       .meaning = std::move(meaning),
       .type = "a table of numbers",
       .entry = &detail::named_number()},
      member, detail::as_named_numbers, detail::written);
}

template <class T>
void Options<T>::setting(std::string name, Setting T::*member, std::string type,
                         std::string meaning) {
  Option option{.name = std::move(name), .meaning = std::move(meaning), .type = std::move(type)};
  option.read = [member](void* object, const Setting& value, const std::string&) {
    static_cast<T*>(object)->*member = value;
  };
  option.write = [member](const void* object) { return static_cast<const T*>(object)->*member; };
  options_.push_back(std::move(option));
}

template <class T>
void Options<T>::points(std::string name, std::vector<Eigen::Vector2d> T::*member,
                        std::string meaning, std::string unit) {
  add(
      {.name = std::move(name),
       .unit = std::move(unit),
       .meaning = std::move(meaning),
       .type = "a list of [x, y] pairs"},
      member,
      [](const Option& option, const Setting& value, const std::string& key) {
        std::vector<Eigen::Vector2d> points;
        for (const Setting& entry : detail::as_list(option, value, key)) {
          points.push_back(detail::as_point(option, entry, key));
        }
        return points;
      },
      [](const std::vector<Eigen::Vector2d>& points) {
        Setting::List list;
        for (const Eigen::Vector2d& p : points) {
          list.push_back(detail::plain(Setting::List{detail::plain(p.x()), detail::plain(p.y())}));
        }
        return list;
      });
}

template <class T>
template <class Enum>
void Options<T>::word(std::string name, Enum T::*member,
                      std::initializer_list<std::pair<std::string, Enum>> words,
                      std::string meaning) {
  const std::vector<std::pair<std::string, Enum>> known(words);
  std::string type = "one of";
  for (const auto& [word, value] : known) type += (type == "one of" ? " \"" : ", \"") + word + '"';
  add(
      {.name = std::move(name), .meaning = std::move(meaning), .type = type}, member,
      [known](const Option& option, const Setting& value, const std::string& key) {
        const std::string& given = detail::as_text(option, value, key);
        std::vector<std::string> names;
        for (const auto& [word, enumerator] : known) {
          if (word == given) return enumerator;
          names.push_back(word);
        }
        throw InputError(value.origin,
                         key + " has no value \"" + given + '"' + suggestion(given, names));
      },
      [known](Enum x) {
        for (const auto& [word, enumerator] : known) {
          if (enumerator == x) return word;
        }
        return std::string("?");
      });
}

template <class T>
template <class Nested>
void Options<T>::table(std::string name, Nested T::*member, std::string meaning) {
  Option option{.name = std::move(name), .meaning = std::move(meaning), .type = "a table"};
  option.table = &schema_of<Nested>();
  option.read = [member](void* object, const Setting& value, const std::string& key) {
    shoal::read(static_cast<T*>(object)->*member, value, key);
  };
  option.write = [member](const void* object) {
    return write_options(schema_of<Nested>(), &(static_cast<const T*>(object)->*member));
  };
  options_.push_back(std::move(option));
}

template <class T>
template <class Nested>
void Options<T>::table(std::string name, std::optional<Nested> T::*member, std::string meaning) {
  Option option{.name = std::move(name), .meaning = std::move(meaning), .type = "a table"};
  option.table = &schema_of<Nested>();
  option.read = [member](void* object, const Setting& value, const std::string& key) {
    shoal::read((static_cast<T*>(object)->*member).emplace(), value, key);
  };
  option.write = [member](const void* object) {
    return write_options(schema_of<Nested>(), &*(static_cast<const T*>(object)->*member));
  };
  option.given = [member](const void* object) {
    return (static_cast<const T*>(object)->*member).has_value();
  };
  options_.push_back(std::move(option));
}

template <class T>
template <class Nested>
void Options<T>::tables(std::string name, std::vector<Nested> T::*member, std::string meaning) {
  Option option{.name = std::move(name), .meaning = std::move(meaning), .type = "a list of tables"};
  const Option described = option;
  option.read = [described, member](void* object, const Setting& value, const std::string& key) {
    std::vector<Nested>& list = static_cast<T*>(object)->*member;
    list.clear();
    for (const Setting& entry : detail::as_list(described, value, key)) {
      shoal::read(list.emplace_back(), entry, key);
    }
  };
  option.write = [member](const void* object) {
    Setting::List list;
    for (const Nested& entry : static_cast<const T*>(object)->*member) {
      list.push_back(write_options(schema_of<Nested>(), &entry));
    }
    return detail::plain(std::move(list));
  };
  options_.push_back(std::move(option));
}

template <class T>
const Schema& schema_of() {
  static const Schema schema = [] {
    Options<T> options;
    T::declare(options);
    Schema made{options.take(), {}, "a scenario"};
    if constexpr (requires { T::noun; }) made.noun = T::noun;
    const T fresh{};
    made.defaults = write_options(made, &fresh);
    for (const Option& option : made.options) {
      if (option.given && !made.defaults.find(option.name)) {
        const Setting none;
        made.defaults.table().emplace_back(option.name,
                                           option.table ? option.table->defaults : none);
      }
    }
    return made;
  }();
  return schema;
}

template <class T>
void read(T& object, const Setting& table, const std::string& path) {
  read_options(schema_of<T>(), &object, table, path);
  if constexpr (requires { object.origin = table.origin; }) object.origin = table.origin;
  if constexpr (requires { object.complaint(); }) {
    if (const std::optional<std::string> wrong = object.complaint()) {
      throw InputError(table.origin, (path.empty() ? "" : path + ": ") + *wrong);
    }
  }
}

}  // namespace shoal
