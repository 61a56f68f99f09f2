#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <thread>

#include "shoal/analysis/experiments/build_info.hpp"
#include "shoal/analysis/experiments/store/trial_outcome.hpp"
#include "shoal/scenarios/toml_file.hpp"

namespace shoal::analysis {
namespace {

using Json = nlohmann::ordered_json;

/// Lines of a text that only machines read would mean nothing in a message.
void forget_origins(Setting& setting) {
  setting.origin = {};
  if (setting.is_table()) {
    for (auto& [name, entry] : setting.table()) forget_origins(entry);
  } else if (auto* list = std::get_if<Setting::List>(&setting.value)) {
    for (Setting& entry : *list) forget_origins(entry);
  }
}

/// One direction of talk with a child. Neither end is inherited by children of other threads.
class Pipe {
 public:
  Pipe() {
    if (::pipe2(ends_.data(), O_CLOEXEC) != 0) {
      throw SystemError(std::string("cannot make a pipe: ") + std::strerror(errno) +
                        "; close other programs, or use fewer --jobs");
    }
  }
  ~Pipe() {
    close_reader();
    close_writer();
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  int reader() const { return ends_[0]; }
  int writer() const { return ends_[1]; }
  void close_reader() { close(ends_[0]); }
  void close_writer() { close(ends_[1]); }

  /// False if the other end was closed before all was said.
  bool say(const std::string& text) {
    std::size_t said = 0;
    while (said < text.size()) {
      const ssize_t n = ::write(writer(), text.data() + said, text.size() - said);
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) return false;
      said += static_cast<std::size_t>(n);
    }
    return true;
  }

  std::string hear() {
    std::string text;
    std::array<char, 65536> buffer;
    while (true) {
      const ssize_t n = ::read(reader(), buffer.data(), buffer.size());
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) return text;
      text.append(buffer.data(), static_cast<std::size_t>(n));
    }
  }

 private:
  static void close(int& end) {
    if (end >= 0) ::close(end);
    end = -1;
  }
  std::array<int, 2> ends_{-1, -1};
};

std::string how_it_ended(int status) {
  if (WIFSIGNALED(status)) {
    return std::string("its process was ended by signal ") + std::to_string(WTERMSIG(status)) +
           " (" + ::strsignal(WTERMSIG(status)) + ")";
  }
  return "its process ended with status " + std::to_string(WEXITSTATUS(status));
}

/// Ends the process once the reader of its answer is gone; never returns.
void end_with_reader() {
  pollfd answer{STDOUT_FILENO, 0, 0};
  while (::poll(&answer, 1, -1) < 0 && errno == EINTR) {
  }
  std::_Exit(1);
}

}  // namespace

std::string trial_request(const scenarios::Scenario& scenario,
                          const std::vector<std::string>& series) {
  return Json{{"program", build_info().program},
              {"scenario", to_toml(scenarios::resolved_scenario(scenario))},
              {"series", series}}
      .dump();
}

std::string trial_answer(const std::string& request) {
  const Json asked = Json::parse(request);
  const std::string program = asked.at("program").get<std::string>();
  if (program != build_info().program) {
    throw InputError("shoal " + program + " asks for a trial, and this is " + build_info().program +
                     "; install the same shoal on all machines");
  }
  Setting root = scenarios::parse_toml(asked.at("scenario").get<std::string>(), "scenario");
  forget_origins(root);
  const TrialOutcome outcome = trial_outcome(scenarios::read_scenario(root), asked.at("series"));
  Json json{{"failure", outcome.failure}, {"wall_s", outcome.wall_s}};
  Json& measures = json["measures"] = Json::array();
  for (const auto& [name, value] : outcome.measures) {
    measures.push_back({name, value ? Json(*value) : Json(nullptr)});
  }
  Json& series = json["series"] = Json::array();
  for (const scenarios::Series& s : outcome.series) {
    series.push_back({s.name, s.unit, s.meaning, s.time_s, s.values});
  }
  return json.dump();
}

TrialOutcome parsed_answer(const std::string& answer) {
  const Json json = Json::parse(answer, nullptr, false);
  if (!json.is_object()) throw SystemError("a worker gave no answer that can be read");
  TrialOutcome outcome;
  outcome.failure = json.at("failure").get<std::string>();
  outcome.wall_s = json.at("wall_s").get<double>();
  for (const Json& measure : json.at("measures")) {
    const Json& value = measure.at(1);
    outcome.measures.emplace_back(
        measure.at(0).get<std::string>(),
        value.is_null() ? std::nullopt : std::optional(value.get<double>()));
  }
  for (const Json& s : json.at("series")) {
    outcome.series.push_back({s.at(0), s.at(1), s.at(2), s.at(3).get<std::vector<double>>(),
                              s.at(4).get<std::vector<double>>()});
  }
  return outcome;
}

TrialOutcome trial_outcome_of_worker(const std::string& program,
                                     const scenarios::Scenario& scenario,
                                     const std::vector<std::string>& series) {
  Pipe request, answer;
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, request.reader(), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, answer.writer(), STDOUT_FILENO);
  std::string command = "trial-worker", name = program;
  std::array<char*, 3> arguments{name.data(), command.data(), nullptr};
  pid_t child = 0;
  const int failed =
      ::posix_spawn(&child, program.c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) {
    throw SystemError("cannot start " + program + ": " + std::strerror(failed) +
                      "; use fewer --jobs");
  }
  request.close_reader();
  answer.close_writer();
  const bool asked = request.say(trial_request(scenario, series));
  request.close_writer();
  const std::string said = answer.hear();
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (asked && WIFEXITED(status) && WEXITSTATUS(status) == 0) return parsed_answer(said);
  TrialOutcome outcome;
  outcome.failure = how_it_ended(status);
  return outcome;
}

void serve_as_worker() {
  std::thread(end_with_reader).detach();
  const std::string request{std::istreambuf_iterator<char>(std::cin), {}};
  std::cout << trial_answer(request) << std::flush;
}

}  // namespace shoal::analysis
