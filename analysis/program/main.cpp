#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <csignal>
#include <exception>
#include <filesystem>
#include <new>
#include <string_view>
#include <system_error>
#include <thread>

#include "commands.hpp"
#include "shoal/analysis/experiments/evaluation.hpp"
#include "shoal/analysis/experiments/plugins.hpp"
#include "shoal/analysis/experiments/store/trial_outcome.hpp"
#include "shoal/analysis/experiments/trial.hpp"
#include "shoal/core/error.hpp"
#include "shoal/core/message.hpp"
#include "shoal/core/text.hpp"
#include "shoal/solvers/solver.hpp"

namespace {

/// A message is one line, whatever names and values it quotes.
std::string one_line(const std::string& message) {
  std::string line;
  for (const char c : message) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      line += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
    } else {
      line += c;
    }
  }
  return line;
}

int complained(const std::string& message, int status) {
  shoal::write_message("shoal: " + one_line(message) + "\n");
  return status;
}

// As of a program that SIGPIPE ends: nothing is wrong when `head` has read enough.
constexpr int reader_has_gone = 128 + SIGPIPE;

// Exit status: 0 done, 1 a run failed, 2 bad input or usage.
int guarded(const std::function<int()>& program) {
  try {
    const int status = program();
    if (std::fflush(stdout) != 0) {
      throw std::system_error(errno, std::generic_category(), "cannot write the output");
    }
    return status;
  } catch (const shoal::InputError& error) {
    return complained(error.what(), 2);
  } catch (const std::filesystem::filesystem_error& error) {
    return complained(error.path1().string() + ": " + error.code().message() +
                          "; name another place, or change its permissions",
                      2);
  } catch (const std::system_error& error) {
    return error.code() == std::errc::broken_pipe ? reader_has_gone : complained(error.what(), 1);
  } catch (const std::bad_alloc&) {
    return complained("there is not enough memory; use fewer vehicles, or record less often", 1);
  } catch (const std::exception& error) {
    return complained(error.what(), 1);
  }
}

/// CLI11 only says that some command is required. Throws CLI::ParseError.
void require_command(const CLI::App& app, const std::string& word) {
  if (word.empty() || word.starts_with('-')) return;
  std::vector<std::string> known;
  for (const CLI::App* each : app.get_subcommands({})) {
    if (each->get_name() == word) return;
    if (!each->get_group().empty()) known.push_back(each->get_name());
  }
  throw CLI::ParseError("there is no command \"" + word + '"' + shoal::suggestion(word, known),
                        CLI::ExitCodes::ExtrasError);
}

/// Before anything asks what there is: those of the environment, and those before the command.
/// Returns where the command stands.
int load_plugins(int argc, char** argv) {
  shoal::analysis::load_plugins_of_environment();
  constexpr std::string_view option = "--plugin";
  int next = 1;
  for (; next < argc && std::string_view(argv[next]).starts_with(option); ++next) {
    const std::string_view argument = argv[next];
    if (argument.starts_with("--plugin=")) {
      shoal::analysis::load_plugin(argument.substr(option.size() + 1));
    } else if (argument == option && next + 1 < argc) {
      shoal::analysis::load_plugin(argv[++next]);
    }
  }
  return next;
}

int shoal_program(int argc, char** argv) {
  // A limit on the size of files, or a reader that has gone, is an error to report, not a signal.
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
  shoal::solvers::silence_backends();
  const int first = load_plugins(argc, argv);

  CLI::App app{
      "shoal: optimisation research toolkit for formation planning of underwater vehicles"};
  app.set_version_flag("--version", "shoal " SHOAL_VERSION);
  std::vector<std::string> plugins;  // see load_plugins()
  app.add_option("--plugin", plugins,
                 "shared library with members of your own; before the command, and may be given "
                 "several times")
      ->expected(1)
      ->take_all();
  app.require_subcommand(1);
  std::function<void()> command;

  shoal::program::RunArguments run;
  CLI::App* run_command = app.add_subcommand("run", "Run one trial of a scenario");
  run_command->add_option("scenario", run.scenario, "a scenario file, or its name in the library")
      ->required();
  run_command
      ->add_option("--set", run.sets, "KEY=VALUE: change one option; may be given several times")
      ->expected(1)
      ->take_all();
  run_command->add_option("--seed", run.seed, "seed of all random numbers (trial.seed)");
  run_command->add_option("--out", run.out, "folder for the results; default: out/SCENARIO");
  run_command
      ->add_option("--threads", run.threads,
                   "threads for large swarms; the numbers do not depend on it")
      ->check(CLI::Range(1, shoal::analysis::most_threads));
  CLI::Option* recorded =
      run_command->add_option("--record-problems", run.problems,
                              "file for the problems that the behaviour poses, for shoal solve");
  run_command
      ->add_option("--keep", run.keep,
                   "with --record-problems: for each vehicle at most so many situations, evenly "
                   "spread over time")
      ->check(CLI::Range(std::size_t{1}, std::size_t{1'000'000'000}))
      ->needs(recorded)
      ->capture_default_str();
  run_command->add_flag("!--no-report", run.report, "write no report.html");
  run_command->callback([&] { command = [&] { shoal::program::run(run); }; });

  shoal::program::SweepArguments sweep;
  sweep.jobs = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  CLI::App* sweep_command =
      app.add_subcommand("sweep", "Run the trials of a study that are not stored yet");
  sweep_command->add_option("study", sweep.study, "a study file, or the name of one that ships")
      ->required();
  CLI::Option* jobs = sweep_command->add_option(
      "--jobs", sweep.jobs, "trials at a time; the numbers do not depend on it");
  jobs->check(CLI::Range(1, shoal::analysis::most_threads))->capture_default_str();
  sweep_command->add_option("--out", sweep.out, "folder of the trials; default: out/STUDY");
  sweep_command->add_option("--shard", sweep.shard,
                            "I/N: only the I-th of N parts; see shoal merge");
  sweep_command->add_option("--replications", sweep.replications, "instead of those of the study")
      ->check(CLI::Range(1, 1000000000));
  CLI::Option* dask = sweep_command->add_option(
      "--dask", sweep.dask,
      "ADDRESS of a scheduler of dask.distributed: its workers run the trials");
  dask->excludes(jobs);
  sweep_command->add_option("--batch", sweep.batch, "with --dask: trials of a task")
      ->needs(dask)
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  sweep_command->add_flag("--fail-fast", sweep.fail_fast,
                          "begin no trial after the first that fails");
  sweep_command->add_flag("--rerun-changed", sweep.rerun_changed,
                          "run stored trials again if study, scenario or program have changed");
  sweep_command->add_flag("--retry-failed", sweep.retry_failed, "run failed trials again");
  sweep_command->add_flag("!--no-figures", sweep.figures,
                          "draw no figures when all trials are done: tables and page only");
  sweep_command->callback([&] { command = [&] { shoal::program::sweep(sweep); }; });

  std::string folder;
  CLI::App* tables_command =
      app.add_subcommand("tables", "Print and write the tables of a study, from what is stored");
  tables_command->add_option("folder", folder, "what shoal sweep wrote")->required();
  tables_command->callback([&] { command = [&] { shoal::program::tables(folder, false); }; });
  CLI::App* claims_command =
      app.add_subcommand("claims", "Test the claims of a study on what is stored");
  claims_command->add_option("folder", folder, "what shoal sweep wrote")->required();
  claims_command->callback([&] { command = [&] { shoal::program::claims(folder); }; });

  std::vector<std::string> parts;
  CLI::App* merge_command = app.add_subcommand(
      "merge", "Unite the trials of parts of a study (shoal sweep --shard) in one folder");
  merge_command->add_option("folder", folder, "where to: a new folder, or one of the parts")
      ->required();
  merge_command->add_option("parts", parts, "folders that shoal sweep wrote")->required();
  merge_command->callback([&] { command = [&] { shoal::program::merge(folder, parts); }; });
  std::string export_to;
  CLI::App* export_command = app.add_subcommand(
      "export", "Write the trials of a study as trials.csv and study.nc, for other programs");
  export_command->add_option("folder", folder, "what shoal sweep wrote")->required();
  export_command->add_option("--out", export_to,
                             "folder of the two files; default: that of the study");
  export_command->callback(
      [&] { command = [&] { shoal::program::export_study(folder, export_to); }; });

  CLI::App* worker_command = app.add_subcommand("trial-worker", "One trial for shoal sweep");
  worker_command->group("");  // not for people
  worker_command->callback([&] { command = [] { shoal::analysis::serve_as_worker(); }; });

  std::string family;
  CLI::App* list_command = app.add_subcommand("list", "List what there is");
  list_command->add_option("family", family,
                           "scenarios, studies, behaviours, plans, currents, solvers ...");
  list_command->callback([&] { command = [&] { shoal::program::list(family); }; });

  std::string name;
  CLI::App* describe_command =
      app.add_subcommand("describe", "Describe a member of a family, or an option");
  describe_command->add_option("name", name, "a name (nlopt.lbfgs) or a key (ping.period_s)")
      ->required();
  describe_command->callback([&] { command = [&] { shoal::program::describe(name); }; });

  std::vector<std::string> files;
  CLI::App* check_command = app.add_subcommand(
      "check", "Check scenarios, studies and other files, and say what was understood");
  check_command
      ->add_option("files", files, "scenario or study (.toml), plan or start (.csv), current (.nc)")
      ->required();
  check_command->callback([&] { command = [&] { shoal::program::check(files); }; });

  shoal::program::CorpusArguments corpus;
  CLI::App* corpus_command = app.add_subcommand(
      "corpus", "Record problems of every scenario of the library with every behaviour");
  corpus_command->add_option("file", corpus.file, "where to write them")->required();
  corpus_command->add_option("--duration", corpus.duration_s, "seconds of every trial")
      ->capture_default_str();
  corpus_command->add_option("--keep", corpus.keep, "situations kept of every trial, evenly spread")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  corpus_command->add_option("--seed", corpus.seed, "seed of the trials")->capture_default_str();
  corpus_command->callback([&] { command = [&] { shoal::program::corpus(corpus); }; });

  const CLI::Validator at_least_0(
      [](const std::string& value) {
        const auto number = shoal::parsed_number(value);
        return std::string(number && *number >= 0.0 ? "" : value + " is no number of at least 0");
      },
      "");
  shoal::program::SolveArguments solve;
  CLI::App* solve_command =
      app.add_subcommand("solve", "Compare solvers side by side on recorded problems");
  solve_command->add_option("problems", solve.corpus, "a file of shoal run --record-problems")
      ->required();
  solve_command
      ->add_option("--solvers", solve.solvers, "NAME,NAME,...: of any family (shoal list solvers)")
      ->delimiter(',')
      ->required();
  solve_command
      ->add_option("--set", solve.sets, "FAMILY.SOLVER.OPTION=VALUE (shoal describe SOLVER)")
      ->expected(1)
      ->take_all();
  solve_command->add_option("--reference", solve.reference,
                            "solver whose minima are the same ones; default: the first");
  solve_command
      ->add_option("--same-within", solve.same_within_m,
                   "metres within which two minima are the same")
      ->check(at_least_0)
      ->capture_default_str();
  solve_command->add_option("--format", solve.format, "of the table (shoal list table_formats)")
      ->capture_default_str();
  solve_command->add_option("--profiles", solve.profiles,
                            "CSV file for Dolan and Moré's performance profiles; progress curves "
                            "are written beside it, as NAME_progress.csv");
  solve_command->callback([&] { command = [&] { shoal::program::solve(solve); }; });

  CLI::App* report_command = app.add_subcommand(
      "report", "Write report.html, a page to look at, into the folder of a run or a study");
  report_command->add_option("folder", folder, "what shoal run or shoal sweep wrote")->required();
  report_command->callback([&] { command = [&] { shoal::program::report(folder); }; });

  CLI::App* figures_command = app.add_subcommand(
      "figures", "Draw the figures of a run, as PDF and SVG (matplotlib); --help tells more");
  figures_command->prefix_command();
  figures_command->set_help_flag();
  figures_command->callback(
      [&] { command = [&] { shoal::program::figures(figures_command->remaining()); }; });

  std::string model;
  std::string inputs;
  CLI::App* eval_command =
      app.add_subcommand("eval", "Print a model's outputs for the inputs in a CSV file");
  eval_command->add_option("model", model, "what to evaluate, as below")->required();
  eval_command->add_option("file", inputs, "CSV file of its inputs")->required();
  eval_command->footer(shoal::analysis::evaluations_text);
  eval_command->callback([&] { command = [&] { shoal::program::eval(model, inputs); }; });

  // An unset variable in a job's script must not stand for a default.
  const CLI::Validator given(
      [](const std::string& value) { return std::string(value.empty() ? "is empty" : ""); }, "");
  for (CLI::App* subcommand : app.get_subcommands({})) {
    for (CLI::Option* option : subcommand->get_options()) {
      if (option->get_items_expected_max() > 0) option->transform(given);  // before all checks
    }
  }

  try {
    if (first < argc) require_command(app, argv[first]);
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    return complained(error.what() + std::string("; see shoal --help"), 2);
  }
  command();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return guarded([&] { return shoal_program(argc, argv); });
}
