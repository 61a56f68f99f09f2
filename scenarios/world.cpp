#include "shoal/scenarios/world.hpp"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>

namespace shoal::scenarios {
namespace {

// Enough vehicles to share the work per call, few enough to stay in the cache for a whole stretch.
constexpr std::size_t usual_block_size = 64;

// The author's log rounds speeds to a centimetre per second before it asks whether they are zero.
constexpr double moving_m_s = 0.005;

constexpr std::int64_t never = std::numeric_limits<std::int64_t>::max();

}  // namespace

World::World(const Scenario& scenario, int threads)
    : scenario_(scenario),
      threads_(threads),
      random_(static_cast<std::uint64_t>(scenario.trial.seed)),
      plan_(std::make_shared<formations::Plan>(scenario.plan.make()->plan())),
      current_(scenario.current.make()),
      obstacles_(make_obstacles(scenario.obstacles)),
      channel_(scenario.ping, random_),
      stop_(scenario.stop.make()),
      fault_(scenario.faults.make()) {
  const auto n = static_cast<std::size_t>(plan_->size());
  if (n < 2) {
    throw InputError(scenario.plan.setting().origin,
                     "the plan has one slot; a swarm needs at least two vehicles");
  }
  const double tick_s = scenario.trial.tick_s;
  current_->require_duration(scenario.trial.duration_s);
  const std::vector<Start> starts = scenario.swarm.start.make()->place(*plan_, random_);
  behaviour_ = scenario.behaviour.make();
  block_size_ = behaviour_->plans_together() ? n : usual_block_size;
  guidance_ = scenario.guidance.make();
  const auto waypoint =
      scenario.waypoint ? std::optional(scenario.waypoint->place()) : std::nullopt;
  require_clear(scenario.obstacles, starts, *plan_, waypoint);
  swarm_ = scenario.swarm.vehicle.make()->launch(starts, scenario.energy, random_, tick_s);

  for (std::size_t i = 0; i < n; ++i) {
    planners_.emplace_back(plan_, behaviour_, plan_->name(static_cast<int>(i)),
                           formations::PlannerParts{.ping_filter = scenario.ping_filter,
                                                    .guidance = guidance_,
                                                    .obstacles = obstacles_,
                                                    .waypoint = waypoint});
  }
  commands_.resize(n);
  hydrophones_.resize(n);
  forget_tick_.assign(n, never);
  u_m_s_.resize(n);
  v_m_s_.resize(n);
  x_before_m_.resize(n);
  y_before_m_.resize(n);
  logbooks_.resize(n);
  lost_s_.assign(n, -1.0);
  arrived_s_.assign(n, -1.0);
  empty_s_.assign(n, -1.0);
  last_propulsion_j_.resize(n);
  if (scenario.ping.carries_state) {
    const double farthest_s = channel_.longest_s() + tick_s;
    reports_kept_ = static_cast<std::size_t>(farthest_s / scenario.ping.period_s) + 2;
    reports_.resize(n * reports_kept_);
  }

  end_tick_ = ticks_of(scenario.trial.duration_s, tick_s, "trial.duration_s");
  guidance_ticks_ =
      ticks_of(guidance_->period_s(), tick_s, "guidance." + scenario.guidance.kind() + ".period_s");
  planner_ticks_ = scenario.planner.update == PlannerOptions::Update::tick
                       ? ticks_of(scenario.planner.period_s, tick_s, "planner.period_s")
                       : 0;
  wake_tick_.assign(n, planner_ticks_ > 0 ? 0 : never);
  loss_ticks_ = fault_->count() > 0 ? ticks_of(fault_->every_s(), tick_s,
                                               "faults." + scenario.faults.kind() + ".every_s")
                                    : 0;
  forget_ticks_ = static_cast<std::int64_t>(scenario.ping_filter.contact_timeout_s / tick_s) + 1;
  for (std::size_t i = 0; i < n; ++i) next_emission_.push_back(emission_tick(i, 0));
}

World::~World() = default;

double World::propulsion_wh(std::size_t i) const {
  return (stopped(i) ? last_propulsion_j_[i] : swarm_->propulsion_j[i]) / joules_per_wh;
}

double World::hotel_wh(std::size_t i) const {
  double until_s = time_s();
  if (lost(i)) until_s = lost_s_[i];
  if (stopped(i)) until_s = std::min(until_s, empty_s_[i]);
  return scenario_.energy.hotel_w * until_s / joules_per_wh;
}

double World::comms_wh(std::size_t i) const {
  return scenario_.energy.ping_j * static_cast<double>(logbooks_[i].pings_sent) / joules_per_wh;
}

void World::run(std::span<Observer* const> observers) {
  std::vector<std::int64_t> looks;  // ticks between two looks of each observer
  for (const Observer* o : observers) {
    looks.push_back(ticks_of(o->every_s(), scenario_.trial.tick_s, "an observer's interval"));
  }
  const auto measures_quality = [](const Observer* o) { return o->quality().has_value(); };
  const auto judge = std::ranges::find_if(observers, measures_quality);
  if (stop_->needs_quality() && judge == observers.end()) {
    throw InputError(scenario_.stop.setting().origin,
                     "stop.kind is " + scenario_.stop.kind() +
                         ", and nothing that observes this world measures the formation quality; "
                         "run it with its measures, or leave stop out");
  }
  // As many threads as asked for, also on a machine with fewer cores.
  const tbb::global_control allowed(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads_));
  tbb::task_arena arena(threads_);
  const std::size_t blocks = (size() + block_size_ - 1) / block_size_;

  while (true) {
    if (arrival_ends_trial() && all_arrived()) end_now("arrival");
    lose_vehicles();
    send_pings();
    for (std::size_t k = 0; k < looks.size(); ++k) {
      if (tick_ % looks[k] == 0) observers[k]->observe(*this);
    }
    if (judge != observers.end() && tick_ != end_tick_ && stop_->met(*(*judge)->quality())) {
      end_now(scenario_.stop.kind());
    }
    if (tick_ == end_tick_) return;

    const std::int64_t until = next_event(looks);
    const auto run_blocks = [&](std::size_t begin, std::size_t end) {
      for (std::size_t b = begin; b < end; ++b) {
        run_block(b * block_size_, std::min(size(), (b + 1) * block_size_), until);
      }
    };
    if (threads_ == 1 || blocks == 1) {
      run_blocks(0, blocks);
    } else {
      arena.execute([&] {
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, blocks),
                          [&](const auto& range) { run_blocks(range.begin(), range.end()); });
      });
    }
    tick_ = until;
  }
}

std::int64_t World::next_event(std::span<const std::int64_t> looks) const {
  // Observers must not change when the trial ends.
  if (arrival_ends_trial()) return tick_ + 1;
  const auto following = [this](std::int64_t ticks) { return (tick_ / ticks + 1) * ticks; };
  std::int64_t next = end_tick_;
  for (const std::int64_t ticks : looks) next = std::min(next, following(ticks));
  if (loss_ticks_ > 0) next = std::min(next, following(loss_ticks_));
  for (std::size_t i = 0; i < size(); ++i) {
    if (!silent(i)) next = std::min(next, next_emission_[i]);
  }
  return next;
}

void World::end_now(const std::string& why) {
  if (tick_ == end_tick_) return;
  end_tick_ = tick_;
  stopped_by_ = why;
}

void World::lose_vehicles() {
  if (loss_ticks_ == 0 || tick_ == 0 || tick_ % loss_ticks_ != 0) return;
  if (tick_ / loss_ticks_ > fault_->count()) return;
  std::vector<std::size_t> left, now;
  for (std::size_t i = 0; i < size(); ++i) {
    if (!lost(i)) left.push_back(i);
  }
  fault_->lose(left, lost_count_, random_, now);
  for (const std::size_t i : now) {
    lost_s_[i] = time_s();
    ++lost_count_;
    commands_[i] = {};
    swarm_->speed_m_s[i] = 0.0;
  }
}

std::int64_t World::emission_tick(std::size_t i, std::int64_t emission) const {
  const double time = channel_.emission_s(i, size(), emission);
  return static_cast<std::int64_t>(std::ceil(time / scenario_.trial.tick_s - 1e-9));
}

void World::send_pings() {
  bool indexed = false;
  for (std::size_t i = 0; i < size(); ++i) {
    if (silent(i) || next_emission_[i] > tick_) continue;
    if (!indexed) {
      // A receiver may come closer by a metre or so while the ping travels.
      grid_.build(swarm_->x_m, swarm_->y_m, scenario_.ping.range_m + 2.0);
      indexed = true;
    }
    const PingUnderway ping{swarm_->x_m[i],
                            swarm_->y_m[i],
                            swarm_->depth_m[i],
                            time_s(),
                            static_cast<std::uint32_t>(i),
                            static_cast<std::uint32_t>(logbooks_[i].pings_sent),
                            reported(i)};
    const double far = scenario_.ping.range_m + 2.0;
    grid_.near(ping.x_m, ping.y_m, [&](std::size_t receiver) {
      if (receiver == i || silent(receiver)) return;
      const double dx = swarm_->x_m[receiver] - ping.x_m;
      const double dy = swarm_->y_m[receiver] - ping.y_m;
      const double dz = swarm_->depth_m[receiver] - ping.depth_m;
      const double squared = dx * dx + dy * dy + dz * dz;
      if (squared > far * far) return;
      if (channel_.loses(ping, static_cast<std::uint32_t>(receiver), std::sqrt(squared))) return;
      hydrophones_[receiver].underway.push_back(ping);
      wake_tick_[receiver] = tick_;
    });
    next_emission_[i] = emission_tick(i, ++logbooks_[i].pings_sent);
  }
}

const formations::OwnState* World::reported(std::size_t sender) {
  if (reports_kept_ == 0) return nullptr;
  const auto emission = static_cast<std::size_t>(logbooks_[sender].pings_sent);
  formations::OwnState& report = reports_[sender * reports_kept_ + emission % reports_kept_];
  report = swarm_->own_state(sender);
  return &report;
}

bool World::arrival_ends_trial() const {
  return scenario_.waypoint && scenario_.waypoint->ends_trial;
}

bool World::all_arrived() const {
  for (std::size_t i = 0; i < size(); ++i) {
    if (!lost(i) && arrived_s_[i] < 0.0) return false;
  }
  return true;
}

void World::note_arrivals(std::size_t first, std::size_t last, double time_s) {
  for (std::size_t i = first; i < last; ++i) {
    if (arrived_s_[i] >= 0.0 || lost(i)) continue;
    const Eigen::Vector2d place(swarm_->x_m[i], swarm_->y_m[i]);
    if ((place - scenario_.waypoint->place()).norm() <= scenario_.waypoint->radius_m) {
      arrived_s_[i] = time_s;
    }
  }
}

void World::note_empty(std::size_t first, std::size_t last, double time_s) {
  const Energy& energy = scenario_.energy;
  for (std::size_t i = first; i < last; ++i) {
    const double spent_j = swarm_->propulsion_j[i] + energy.hotel_w * time_s +
                           energy.ping_j * static_cast<double>(logbooks_[i].pings_sent);
    if (spent_j < energy.battery_wh * joules_per_wh || empty_s_[i] >= 0.0 || lost(i)) continue;
    empty_s_[i] = time_s;
    last_propulsion_j_[i] = swarm_->propulsion_j[i];
    if (stopped(i)) commands_[i] = {};
  }
}

void World::guide(std::size_t i) {
  // Only own positions come without a virtual call.
  commands_[i] = planners_[i].command(
      guidance_->needs_motion() ? swarm_->own_state(i)
                                : formations::OwnState{.position = swarm_->own_position(i)});
  if (commands_[i].outside_envelope) logbooks_[i].outside_envelope_s += guidance_->period_s();
}

bool World::listen(std::size_t i, std::int64_t tick) {
  const double now = static_cast<double>(tick) * scenario_.trial.tick_s;
  bool due = planner_ticks_ > 0 ? tick % planner_ticks_ == 0 : tick >= forget_tick_[i];
  if (!hydrophones_[i].underway.empty()) {
    thread_local std::vector<Reception> received;
    received.clear();
    channel_.listen(*swarm_, i, now, scenario_.trial.tick_s, hydrophones_[i], received);
    const Eigen::Vector2d error =
        swarm_->own_position(i) - Eigen::Vector2d(swarm_->x_m[i], swarm_->y_m[i]);
    for (const Reception& r : received) planners_[i].receive(r.ping, r.own_position + error);
    if (planner_ticks_ == 0) due |= !received.empty();
  }
  return due;
}

void World::set_alarms(std::size_t i, std::int64_t tick, bool planned) {
  if (planned) {
    // A vehicle that hears no other any more must notice without a ping.
    const formations::Reason reason = planners_[i].last_target().reason;
    forget_tick_[i] = reason == formations::Reason::no_neighbour ? never : tick + forget_ticks_;
  }
  wake_tick_[i] = !hydrophones_[i].underway.empty() ? tick + 1
                  : planner_ticks_ > 0              ? (tick / planner_ticks_ + 1) * planner_ticks_
                                                    : forget_tick_[i];
}

void World::listen_and_plan(std::size_t first, std::size_t last, std::int64_t tick) {
  const double now = static_cast<double>(tick) * scenario_.trial.tick_s;
  const auto awake = [&](std::size_t i) { return !silent(i) && tick >= wake_tick_[i]; };
  if (!behaviour_->plans_together()) {
    for (std::size_t i = first; i < last; ++i) {
      if (!awake(i)) continue;
      const bool due = listen(i, tick);
      if (due) planners_[i].plan(now, swarm_->own_state(i));
      set_alarms(i, tick, due);
    }
    return;
  }
  thread_local std::vector<formations::Planner*> due;
  thread_local std::vector<formations::OwnState> own;
  thread_local std::vector<std::size_t> which;
  due.clear();
  own.clear();
  which.clear();
  for (std::size_t i = first; i < last; ++i) {
    if (!awake(i)) continue;
    if (!listen(i, tick)) {
      set_alarms(i, tick, false);
      continue;
    }
    which.push_back(i);
    due.push_back(&planners_[i]);
    own.push_back(swarm_->own_state(i));
  }
  formations::Planner::plan_together(due, now, own);
  for (const std::size_t i : which) set_alarms(i, tick, true);
}

void World::run_block(std::size_t first, std::size_t last, std::int64_t until) {
  const double tick_s = scenario_.trial.tick_s;
  const std::size_t count = last - first;
  Swarm& swarm = *swarm_;
  const std::span<const double> x(swarm.x_m.data() + first, count);
  const std::span<const double> y(swarm.y_m.data() + first, count);
  const std::span<const double> depth(swarm.depth_m.data() + first, count);
  const std::span<double> u(u_m_s_.data() + first, count);
  const std::span<double> v(v_m_s_.data() + first, count);
  const std::span<double> x_before(x_before_m_.data() + first, count);
  const std::span<double> y_before(y_before_m_.data() + first, count);

  for (std::int64_t tick = tick_; tick < until; ++tick) {
    const bool guided = tick % guidance_ticks_ == 0;
    listen_and_plan(first, last, tick);
    if (guided) {
      for (std::size_t i = first; i < last; ++i) {
        if (!silent(i)) guide(i);
      }
    }

    current_->sample_at(static_cast<double>(tick) * tick_s, x, y, depth, u, v);
    if (lost_count_ > 0) {
      for (std::size_t i = first; i < last; ++i) {
        if (lost(i)) u_m_s_[i] = v_m_s_[i] = 0.0;
      }
    }
    std::ranges::copy(x, x_before.begin());
    std::ranges::copy(y, y_before.begin());
    swarm.advance(first, last, tick, commands_, u_m_s_, v_m_s_);

    for (std::size_t i = first; i < last; ++i) {
      const double dx = swarm.x_m[i] - x_before[i - first];
      const double dy = swarm.y_m[i] - y_before[i - first];
      const double path = std::sqrt(dx * dx + dy * dy);
      Logbook& log = logbooks_[i];
      log.distance_m += path;
      log.thrust_distance_m += swarm.speed_m_s[i] >= moving_m_s ? path : 0.0;
      log.thrusting_s += commands_[i].thrust ? tick_s : 0.0;
    }
    note_empty(first, last, static_cast<double>(tick + 1) * tick_s);
    if (scenario_.waypoint) note_arrivals(first, last, static_cast<double>(tick + 1) * tick_s);
  }
}

}  // namespace shoal::scenarios
