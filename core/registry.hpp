#pragma once

#include <algorithm>
#include <concepts>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <typeinfo>
#include <utility>
#include <vector>

#include "shoal/core/options.hpp"

namespace shoal {

/// What is known of one member of a family without its type.
struct MemberInfo {
  std::string name;     ///< may be dotted (`nlopt.lbfgs`): its options then sit in nested tables
  std::string summary;  ///< one line: what it does, and its source
  std::function<const Schema&()> schema;
  /// Reads the options of this member and throws InputError if they are wrong.
  std::function<void(const Setting& table, const std::string& path)> check;
  /// The options as given, completed by the defaults.
  std::function<Setting(const Setting& table, const std::string& path)> complete;
  const std::type_info* type = nullptr;  ///< of its options, for Choice
  std::string left_out_by;  ///< option of the build (`SHOAL_NLOPT`) without which it is not there
};

/// A family of interchangeable things (behaviours, currents ...), with the types erased.
class RegistryBase {
 public:
  RegistryBase(std::string family, std::string meaning);
  RegistryBase(const RegistryBase&) = delete;
  RegistryBase& operator=(const RegistryBase&) = delete;

  const std::string& family() const { return family_; }
  const std::string& meaning() const { return meaning_; }

  /// Grows with each change of the members, for what is derived from them.
  std::size_t generation() const { return generation_; }

  /// Sorted by name; the order of registration depends on the linker and must not show.
  const std::vector<MemberInfo>& members() const { return members_; }
  std::vector<std::string> names() const;

  /// The member of that name, or nullptr.
  const MemberInfo* find(std::string_view name) const;
  /// Whether members are called `name.something`.
  bool has_below(std::string_view name) const;

  /// The member whose options are of that type. Throws std::logic_error unless there is exactly
  /// one.
  const MemberInfo& of_type(const std::type_info& type) const;

  /// Throws InputError, naming the known members, if there is none of that name, and if it was left
  /// out of this build.
  std::size_t index_of(std::string_view name, const Origin& origin, const std::string& key) const;

 protected:
  /// Throws std::logic_error if the name is taken, or is a dotted prefix of another.
  std::size_t insert(MemberInfo info);
  /// Its place, if there is one of that name.
  std::optional<std::size_t> replace(MemberInfo info);

 private:
  std::string family_;
  std::string meaning_;
  std::vector<MemberInfo> members_;
  std::size_t generation_ = 0;
};

/// While it lives, members of this thread that cannot be registered are noted instead of throwing:
/// nothing may be thrown through the loader of a shared library.
class RegistryWatch {
 public:
  RegistryWatch();
  ~RegistryWatch();
  RegistryWatch(const RegistryWatch&) = delete;
  RegistryWatch& operator=(const RegistryWatch&) = delete;

  /// What went wrong first; "" if nothing did.
  const std::string& failure() const { return failure_; }

  /// Registers, or notes for the watch (if there is one) why it cannot.
  static void add(const std::function<void()>& registration);

 private:
  std::string failure_;
};

/// All families that something is registered in, sorted by name.
std::vector<const RegistryBase*> families();
/// One of them, or nullptr.
const RegistryBase* family_named(std::string_view name);

/// The dotted key at which a struct, or what can be chosen in it, first chooses from the family
/// (`behaviour.attraction_repulsion.solver`); "" if nothing does.
std::string key_of(const RegistryBase& family, const Schema& schema);

/// name -> factory. `Family::family` names it, `Family::family_meaning` says what it is.
template <class Family>
class Registry : public RegistryBase {
 public:
  using Factory = std::function<std::unique_ptr<Family>(const Setting&, const std::string& path)>;

  static Registry& instance() {
    static Registry registry;
    return registry;
  }

  void add(MemberInfo info, Factory factory) {
    const auto place = static_cast<std::ptrdiff_t>(insert(std::move(info)));
    factories_.insert(factories_.begin() + place, std::move(factory));
  }

  /// The same for a member that is written while the program runs, and so perhaps once more: it
  /// takes the place of the one before. Not while another thread may ask for members.
  void put(MemberInfo info, Factory factory) {
    if (const auto place = replace(info)) {
      factories_[*place] = std::move(factory);
    } else {
      add(std::move(info), std::move(factory));
    }
  }

  std::unique_ptr<Family> make(std::string_view name, const Setting& table,
                               const std::string& path) const {
    return factories_[index_of(name, table.origin, path)](table, path);
  }

 private:
  Registry() : RegistryBase(Family::family, Family::family_meaning) {}
  std::vector<Factory> factories_;
};

/// Registers a member at start-up:
///
///     const Register<Behaviour, RigidRegistration> registered{"rigid_registration", "..."};
///
/// `Declared` is a declared struct. It either is the member, or a maker turns it into one.
template <class Family, class Declared>
struct Register {
  Register(std::string name, std::string summary) requires std::derived_from<Declared, Family>
      : Register(std::move(name), std::move(summary),
                 [](const Declared& member) { return std::make_unique<Declared>(member); }) {}

  template <class Maker>
  Register(std::string name, std::string summary, Maker maker) {
    MemberInfo info{std::move(name),
                    std::move(summary),
                    &schema_of<Declared>,
                    [](const Setting& table, const std::string& path) {
                      Declared declared;
                      read(declared, table, path);
                    },
                    [](const Setting& table, const std::string& path) {
                      Declared declared;
                      read(declared, table, path);
                      return write_options(schema_of<Declared>(), &declared);
                    },
                    &typeid(Declared)};
    RegistryWatch::add([&] {
      Registry<Family>::instance().add(
          std::move(info),
          [maker](const Setting& table, const std::string& path) -> std::unique_ptr<Family> {
            Declared declared;
            read(declared, table, path);
            return maker(declared);
          });
    });
  }
};

/// What was chosen from a family: the kind, and the options given for this and for other kinds
/// (so that `--set behaviour.kind=...` finds its options in the same file).
struct ChoiceSetting {
  std::string kind;
  Setting tables;    ///< kind, dotted or not -> table of its options
  std::string path;  ///< dotted name of the choice, for messages
  Origin origin;

  void read(const RegistryBase& registry, const Setting& value, const std::string& key);
  Setting write(const RegistryBase& registry) const;
  const Setting& options() const;  ///< the table of the chosen kind
};

/// What was given for members of a family that are all in use.
struct MemberOptions {
  Setting tables;  ///< name, dotted or not -> table of its options

  void read(const RegistryBase& registry, const Setting& value, const std::string& key);
  /// Those that were given, each completed by its defaults.
  Setting write(const RegistryBase& registry) const;
  /// Of the member of that name; empty if none were given.
  const Setting& of(std::string_view name) const;
};

/// A struct with declared options.
template <class T>
concept DeclaredOptions = requires(Options<T>& options) {
  T::declare(options);
};

/// A member of a family with its options: by its name, or by its type, so that the compiler knows
/// the options:
///
///     Choice<Behaviour> rigid = RigidRegistration{.ownship_weight = 0.5};
template <class Family>
class Choice {
 public:
  Choice(std::string kind) { setting_.kind = std::move(kind); }  // NOLINT: `= "thesis"` reads well
  Choice(const char* kind) { setting_.kind = kind; }             // NOLINT: as above
  template <DeclaredOptions Member>
  Choice(const Member& options) {  // NOLINT: as above
    setting_.kind = Registry<Family>::instance().of_type(typeid(Member)).name;
    setting_.tables.at_or_new(setting_.kind) = write_options(schema_of<Member>(), &options);
  }

  const std::string& kind() const { return setting_.kind; }
  ChoiceSetting& setting() { return setting_; }
  const ChoiceSetting& setting() const { return setting_; }

  /// Throws InputError if no kind of that name is known.
  std::unique_ptr<Family> make() const {
    return Registry<Family>::instance().make(
        kind(), setting_.options(),
        (setting_.path.empty() ? std::string(Family::family) : setting_.path) + "." + kind());
  }

 private:
  ChoiceSetting setting_;
};

/// Makes a member from its options. Throws InputError if they are out of their ranges.
template <class Family, DeclaredOptions Member>
std::unique_ptr<Family> make(const Member& options) {
  return Choice<Family>(options).make();
}

template <class T>
template <class Family>
void Options<T>::choice(std::string name, Choice<Family> T::*member, std::string meaning) {
  Option option{
      .name = std::move(name), .meaning = std::move(meaning), .type = "a table with a kind"};
  option.choice = &Registry<Family>::instance();
  option.read = [member](void* object, const Setting& value, const std::string& key) {
    (static_cast<T*>(object)->*member).setting().read(Registry<Family>::instance(), value, key);
  };
  option.write = [member](const void* object) {
    return (static_cast<const T*>(object)->*member).setting().write(Registry<Family>::instance());
  };
  options_.push_back(std::move(option));
}

template <class T>
void Options<T>::members(std::string name, MemberOptions T::*member, const RegistryBase& family,
                         std::string meaning) {
  Option option{
      .name = std::move(name), .meaning = std::move(meaning), .type = "a table of members"};
  option.choice = &family;
  option.of_all = true;
  option.read = [member, &family](void* object, const Setting& value, const std::string& key) {
    (static_cast<T*>(object)->*member).read(family, value, key);
  };
  option.write = [member, &family](const void* object) {
    return (static_cast<const T*>(object)->*member).write(family);
  };
  option.given = [member](const void* object) {
    return !(static_cast<const T*>(object)->*member).tables.table().empty();
  };
  options_.push_back(std::move(option));
}

}  // namespace shoal
