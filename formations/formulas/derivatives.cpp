#include "shoal/formations/formulas/derivatives.hpp"

#include <ginac/ginac.h>

#include <algorithm>
#include <array>
#include <bit>
#include <mutex>
#include <string>
#include <utility>

#include "shoal/core/error.hpp"

namespace shoal::formations::formulas {
namespace {

using GiNaC::ex;
using GiNaC::is_a;
using Operand = ProgramBuilder::Operand;

struct Counterpart {
  Operation operation;
  ex (*make)(const ex&);
  const char* name;  // GiNaC's
};
const std::array counterparts{
    Counterpart{Operation::exponential, [](const ex& x) -> ex { return exp(x); }, "exp"},
    Counterpart{Operation::logarithm, [](const ex& x) -> ex { return log(x); }, "log"},
    Counterpart{Operation::sine, [](const ex& x) -> ex { return sin(x); }, "sin"},
    Counterpart{Operation::cosine, [](const ex& x) -> ex { return cos(x); }, "cos"},
    Counterpart{Operation::tangent, [](const ex& x) -> ex { return tan(x); }, "tan"},
    Counterpart{Operation::arcsine, [](const ex& x) -> ex { return asin(x); }, "asin"},
    Counterpart{Operation::arccosine, [](const ex& x) -> ex { return acos(x); }, "acos"},
    Counterpart{Operation::arctangent, [](const ex& x) -> ex { return atan(x); }, "atan"},
    Counterpart{Operation::hyperbolic_sine, [](const ex& x) -> ex { return sinh(x); }, "sinh"},
    Counterpart{Operation::hyperbolic_cosine, [](const ex& x) -> ex { return cosh(x); }, "cosh"},
    Counterpart{Operation::hyperbolic_tangent, [](const ex& x) -> ex { return tanh(x); }, "tanh"}};

bool is_small_whole(double x) {
  return x == std::floor(x) && std::abs(x) <= largest_whole_power;
}

/// Translates trees to GiNaC's expressions, and these to steps.
class Translator {
 public:
  explicit Translator(ProgramBuilder& builder) : builder_(builder) {}

  const GiNaC::symbol& distance() const { return r_; }

  ex expression(const Tree& tree, const std::vector<Operand>& operands) {
    std::vector<ex> made;
    for (const Tree::Node& n : tree.nodes) {
      const auto at = [&](int i) { return static_cast<std::size_t>(i); };
      switch (n.operation) {
        case Operation::number:
          made.emplace_back(GiNaC::numeric(n.number));
          break;
        case Operation::distance:
          made.emplace_back(r_);
          break;
        case Operation::separation:
          made.emplace_back(s_);
          break;
        case Operation::add:
          made.push_back(made[at(n.a)] + made[at(n.b)]);
          break;
        case Operation::subtract:
          made.push_back(made[at(n.a)] - made[at(n.b)]);
          break;
        case Operation::multiply:
          made.push_back(made[at(n.a)] * made[at(n.b)]);
          break;
        case Operation::divide:
          made.push_back(made[at(n.a)] / made[at(n.b)]);
          break;
        case Operation::negate:
          made.push_back(-made[at(n.a)]);
          break;
        case Operation::square_root:
          made.push_back(pow(made[at(n.a)], GiNaC::numeric(0.5)));
          break;
        case Operation::power: {
          // Small whole exponents are exact, so that powers join; all else is of bounded length,
          // or 9^9^9 would keep GiNaC busy for ever.
          const Tree::Node& b = tree.nodes[at(n.b)];
          const bool whole = b.operation == Operation::number && is_small_whole(b.number);
          made.push_back(pow(made[at(n.a)],
                             whole ? GiNaC::numeric(static_cast<int>(b.number)) : made[at(n.b)]));
          break;
        }
        // On either side of a kink, which side it is does not change with r.
        case Operation::absolute:
          made.push_back(made[at(n.a)] * side(Operation::sign, operands[at(n.a)]));
          break;
        case Operation::minimum:
        case Operation::maximum: {
          const ex below =
              side(Operation::is_less, operand(tree, operands, n.a), operand(tree, operands, n.b));
          const bool least = n.operation == Operation::minimum;
          made.push_back(below * made[at(least ? n.a : n.b)] +
                         (1 - below) * made[at(least ? n.b : n.a)]);
          break;
        }
        default:
          made.push_back(counterpart(n.operation).make(made[at(n.a)]));
      }
    }
    return made.back();
  }

  Operand emit(const ex& e) {
    if (is_a<GiNaC::numeric>(e)) return builder_.constant(number(e));
    if (is_a<GiNaC::symbol>(e)) return symbol(e);
    if (is_a<GiNaC::add>(e)) return sum(e);
    if (is_a<GiNaC::mul>(e)) return product(e);
    if (is_a<GiNaC::power>(e)) {
      const ex exponent = e.op(1);
      if (is_a<GiNaC::numeric>(exponent)) return builder_.power(emit(e.op(0)), number(exponent));
      return builder_.step(Operation::power, emit(e.op(0)), emit(exponent));
    }
    if (is_a<GiNaC::function>(e) && e.nops() == 1) {
      const std::string name = GiNaC::ex_to<GiNaC::function>(e).get_name();
      for (const Counterpart& c : counterparts) {
        if (name == c.name) return builder_.step(c.operation, emit(e.op(0)));
      }
    }
    throw InputError("its derivative cannot be evaluated");
  }

 private:
  static const Counterpart& counterpart(Operation operation) {
    return *std::ranges::find(counterparts, operation, &Counterpart::operation);
  }

  Operand operand(const Tree& tree, const std::vector<Operand>& operands, int node) {
    const Tree::Node& n = tree.nodes[static_cast<std::size_t>(node)];
    return n.operation == Operation::number ? builder_.constant(n.number)
                                            : operands[static_cast<std::size_t>(node)];
  }

  ex side(Operation operation, Operand a, Operand b = ProgramBuilder::distance) {
    const GiNaC::realsymbol made("side" + std::to_string(sides_.size()));
    sides_.push_back({made, operation, a, b});
    return made;
  }

  Operand symbol(const ex& e) {
    if (e.is_equal(r_)) return ProgramBuilder::distance;
    if (e.is_equal(s_)) return ProgramBuilder::separation;
    const auto side = std::ranges::find_if(sides_, [&](const Side& s) { return e.is_equal(s.is); });
    return builder_.step(side->operation, side->a, side->b);
  }

  static double number(const ex& e) {
    const auto& n = GiNaC::ex_to<GiNaC::numeric>(e);
    const double x = n.is_real() ? n.to_double() : std::numeric_limits<double>::quiet_NaN();
    if (!std::isfinite(x)) throw InputError("its derivative has a factor that is not finite");
    return x;
  }

  /// A term without its sign.
  static std::pair<bool, ex> split(const ex& e) {
    const ex last = is_a<GiNaC::mul>(e) ? e.op(e.nops() - 1) : e;
    const bool negative =
        is_a<GiNaC::numeric>(last) && GiNaC::ex_to<GiNaC::numeric>(last).is_negative();
    return {negative, negative ? -e : e};
  }

  /// What an expression is, but for its sign; and its sign.
  struct Key {
    std::uint64_t key = 0;
    bool negative = false;
  };

  // GiNaC orders operands by addresses, which change from run to run, and pulls signs out of sums
  // accordingly: x - y may come as -(y - x). Ours go by keys that do not depend on either.
  Key key(const ex& e) {
    const auto known = keys_.find(e);
    if (known != keys_.end()) return known->second;
    const Key made = new_key(e);
    keys_.emplace(e, made);
    return made;
  }

  Key new_key(const ex& e) {
    if (is_a<GiNaC::numeric>(e)) {
      const double x = number(e);
      return {mixed(1, std::bit_cast<std::uint64_t>(std::abs(x))), x < 0.0};
    }
    if (is_a<GiNaC::symbol>(e)) {
      return {mixed(2, GiNaC::ex_to<GiNaC::symbol>(e).get_name()), false};
    }
    if (is_a<GiNaC::power>(e)) {
      const Key base = key(e.op(0));
      const Key exponent = key(e.op(1));
      const bool whole = e.op(1).info(GiNaC::info_flags::integer);
      const bool odd = whole && e.op(1).info(GiNaC::info_flags::odd);
      const std::uint64_t signs =
          (exponent.negative ? 1u : 0u) + (base.negative && !whole ? 2u : 0u);
      return {mixed(mixed(mixed(3, base.key), exponent.key), signs), base.negative && odd};
    }
    std::vector<Key> parts;
    for (const ex& part : e) parts.push_back(key(part));
    std::ranges::sort(parts, {}, &Key::key);
    if (is_a<GiNaC::add>(e)) {
      Key sum{4, parts.front().negative};
      for (const Key& part : parts) {
        sum.key = mixed(mixed(sum.key, part.key), part.negative != sum.negative ? 1 : 0);
      }
      return sum;
    }
    if (is_a<GiNaC::mul>(e)) {
      const std::uint64_t one = key(1).key;  // all that is left of a factor of -1: -x is as x
      const auto factors = std::ranges::count_if(parts, [&](const Key& p) { return p.key != one; });
      Key product{factors > 1 ? 5u : 0u, false};
      for (const Key& part : parts) {
        product.negative ^= part.negative;
        if (part.key == one) continue;
        product.key = factors > 1 ? mixed(product.key, part.key) : part.key;
      }
      return product;
    }
    Key call{6, false};
    if (is_a<GiNaC::function>(e)) {
      call.key = mixed(call.key, GiNaC::ex_to<GiNaC::function>(e).get_name());
    }
    for (const Key& part : parts) {
      call.key = mixed(mixed(call.key, part.key), part.negative ? 1 : 0);
    }
    return call;
  }

  static std::uint64_t mixed(std::uint64_t a, const std::string& text) {
    for (const char c : text) a = mixed(a, static_cast<std::uint64_t>(c));
    return a;
  }
  static std::uint64_t mixed(std::uint64_t a, std::uint64_t b) {
    std::uint64_t x = (a ^ (b + 0x9e3779b97f4a7c15u + (a << 6) + (a >> 2))) * 0xbf58476d1ce4e5b9u;
    return x ^ (x >> 31);
  }

  std::vector<ex> in_order(const ex& e) {
    std::vector<std::pair<std::uint64_t, ex>> parts;
    for (const ex& part : e) parts.emplace_back(key(part).key, part);
    std::ranges::stable_sort(parts, {}, &std::pair<std::uint64_t, ex>::first);
    std::vector<ex> sorted;
    for (const auto& [k, part] : parts) sorted.push_back(part);
    return sorted;
  }

  // The first term gives the sign of the whole, so that x - y and y - x round alike.
  Operand sum(const ex& e) {
    const std::vector<ex> terms = in_order(e);
    const auto [reversed, first] = split(terms.front());
    Operand total = emit(first);
    for (std::size_t i = 1; i < terms.size(); ++i) {
      const auto [negative, term] = split(terms[i]);
      const Operand next = emit(term);
      if (negative == reversed) {
        total = builder_.step(Operation::add, total, next);
      } else if (reversed && i + 1 == terms.size()) {
        return builder_.step(Operation::subtract, next, total);  // -(total - next), bit for bit
      } else {
        total = builder_.step(Operation::subtract, total, next);
      }
    }
    return reversed ? builder_.step(Operation::negate, total) : total;
  }

  Operand product(const ex& whole) {
    const auto [negative, e] = split(whole);
    std::vector<Operand> above, below;
    if (is_a<GiNaC::mul>(e)) {
      for (const ex& factor : in_order(e)) {
        const bool divides = is_a<GiNaC::power>(factor) && split(factor.op(1)).first;
        (divides ? below : above).push_back(emit(divides ? 1 / factor : factor));
      }
    } else {
      above.push_back(emit(e));  // it was a product with -1
    }
    Operand result = above.empty() ? builder_.constant(1.0) : multiplied(above);
    if (!below.empty()) result = builder_.step(Operation::divide, result, multiplied(below));
    return negative ? builder_.step(Operation::negate, result) : result;
  }

  Operand multiplied(const std::vector<Operand>& factors) {
    Operand all = factors.front();
    for (std::size_t i = 1; i < factors.size(); ++i) {
      all = builder_.step(Operation::multiply, all, factors[i]);
    }
    return all;
  }

  struct Side {
    ex is;
    Operation operation;
    Operand a, b;
  };

  ProgramBuilder& builder_;
  // Positive, so that GiNaC keeps to the reals: sqrt(r^2) is r.
  const GiNaC::possymbol r_{"r"}, s_{"s"};
  std::vector<Side> sides_;
  std::map<ex, Key, GiNaC::ex_is_less> keys_;
};

}  // namespace

Program differentiated(const Tree& tree) {
  // GiNaC counts references without locks, also those of its own constants.
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  // Long enough for the order of GiNaC's own sums not to show in a double.
  GiNaC::Digits = 60;
  try {
    ProgramBuilder builder;
    const std::vector<Operand> operands = builder.append(tree);
    builder.value_is(operands.back());
    Translator translator(builder);
    const ex slope = translator.expression(tree, operands).diff(translator.distance());
    const Operand first = translator.emit(slope);
    const Operand second = translator.emit(slope.diff(translator.distance()));
    return builder.finished(first, second);
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& error) {
    throw InputError(std::string("it has no derivative: ") + error.what());
  }
}

}  // namespace shoal::formations::formulas
