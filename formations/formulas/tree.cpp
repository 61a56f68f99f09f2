#include "shoal/formations/formulas/tree.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <numbers>
#include <optional>
#include <string>

#include "shoal/core/error.hpp"
#include "shoal/core/text.hpp"

namespace shoal::formations::formulas {
namespace {

constexpr std::size_t longest_text = 500;
constexpr int deepest_nesting = 50;

struct Function {
  std::string_view name;
  Operation operation;
};
constexpr std::array functions{Function{"abs", Operation::absolute},
                               Function{"acos", Operation::arccosine},
                               Function{"asin", Operation::arcsine},
                               Function{"atan", Operation::arctangent},
                               Function{"cos", Operation::cosine},
                               Function{"cosh", Operation::hyperbolic_cosine},
                               Function{"exp", Operation::exponential},
                               Function{"log", Operation::logarithm},
                               Function{"max", Operation::maximum},
                               Function{"min", Operation::minimum},
                               Function{"pow", Operation::power},
                               Function{"sin", Operation::sine},
                               Function{"sinh", Operation::hyperbolic_sine},
                               Function{"sqrt", Operation::square_root},
                               Function{"tan", Operation::tangent},
                               Function{"tanh", Operation::hyperbolic_tangent}};

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// Throws InputError unless the names are words that mean nothing else, each once.
void require_own_names(const NamedNumbers& numbers) {
  std::vector<std::string_view> known{"r", "s", "pi"};
  for (const Function& function : functions) known.push_back(function.name);
  for (const auto& [name, value] : numbers) {
    const bool word = !name.empty() && is_letter(name.front()) &&
                      std::ranges::all_of(name, [](char c) { return is_letter(c) || is_digit(c); });
    if (!word) {
      throw InputError("a parameter is named by letters, digits and _, a letter first; not \"" +
                       name + '"');
    }
    if (std::ranges::find(known, name) != known.end()) {
      throw InputError("the parameter " + name + " needs another name: " + name +
                       " has a meaning already");
    }
    known.push_back(name);
  }
}

/// Recursive descent, one function a level of precedence.
class Parser {
 public:
  Parser(std::string_view text, const NamedNumbers& named_numbers)
      : text_(text), named_numbers_(named_numbers) {}

  Tree parse() {
    if (text_.size() > longest_text) {
      throw InputError("it has " + std::to_string(text_.size()) + " characters; at most " +
                       std::to_string(longest_text) + " are read");
    }
    sum();
    if (!at_end()) {
      fail(text_[at_] == ')' ? "there is a ')' too many"
                             : "an operator is missing before " + rest());
    }
    for (std::size_t k = 0; k < named_numbers_.size(); ++k) {
      if (!occurs_[k])
        throw InputError("it does not have the parameter " + named_numbers_[k].first);
    }
    return std::move(tree_);
  }

 private:
  int sum() {
    const Nesting nesting(*this);
    int left = product();
    while (const auto o = one_of("+-")) {
      const std::size_t where = at_ - 1;
      left = node(*o == '+' ? Operation::add : Operation::subtract, left, product(), where);
    }
    return left;
  }

  int product() {
    int left = signed_power();
    while (const auto o = one_of("*/")) {
      const std::size_t where = at_ - 1;
      left = node(*o == '*' ? Operation::multiply : Operation::divide, left, signed_power(), where);
    }
    return left;
  }

  int signed_power() {
    const Nesting nesting(*this);
    if (const auto o = one_of("+-")) {
      const std::size_t where = at_ - 1;
      const int operand = signed_power();
      return *o == '-' ? node(Operation::negate, operand, -1, where) : operand;
    }
    const int base = primary();
    if (!one_of("^")) return base;
    const std::size_t where = at_ - 1;
    return node(Operation::power, base, signed_power(), where);
  }

  int primary() {
    if (at_end()) fail("it ends where a value is expected");
    const char c = text_[at_];
    if (c == '(') {
      const std::size_t opened = at_++;
      const int inside = sum();
      close(opened);
      return inside;
    }
    if (is_digit(c) || c == '.') return number();
    if (is_letter(c)) return named();
    if (c == ')') fail("a value is expected before ')'");
    fail("a value is expected, not " + rest());
  }

  int number() {
    double value = 0.0;
    const char* const end = text_.data() + text_.size();
    const auto [stop, error] = std::from_chars(text_.data() + at_, end, value);
    if (error == std::errc::result_out_of_range) fail("this number is too large or too small");
    if (error != std::errc()) fail("there is no number like " + rest());
    at_ = static_cast<std::size_t>(stop - text_.data());
    return leaf(Operation::number, value);
  }

  int named() {
    const std::size_t where = at_;
    while (at_ < text_.size() && (is_letter(text_[at_]) || is_digit(text_[at_]))) ++at_;
    const std::string name(text_.substr(where, at_ - where));
    if (!at_end() && text_[at_] == '(') return call(name, where);
    if (name == "r") return leaf(Operation::distance);
    if (name == "s") return leaf(Operation::separation);
    if (name == "pi") return leaf(Operation::number, std::numbers::pi);
    for (std::size_t k = 0; k < named_numbers_.size(); ++k) {
      if (name != named_numbers_[k].first) continue;
      occurs_[k] = true;
      return leaf(Operation::number, named_numbers_[k].second);
    }
    at_ = where;
    if (std::ranges::find(functions, name, &Function::name) != functions.end()) {
      fail(name + " is a function; write " + name + "(...)");
    }
    std::string known = "r (distance, m), s (separation, m)";
    for (const auto& [own, value] : named_numbers_) known += ", " + own;
    fail("there is no symbol \"" + name + "\"; known are " + known + " and pi");
  }

  int call(const std::string& name, std::size_t where) {
    const auto* const function = std::ranges::find(functions, name, &Function::name);
    if (function == functions.end()) {
      std::vector<std::string> known;
      for (const Function& f : functions) known.emplace_back(f.name);
      at_ = where;
      fail("there is no function \"" + name + '"' + suggestion(name, known));
    }
    const std::size_t opened = at_++;
    const int a = sum();
    int b = -1;
    if (is_binary(function->operation)) {
      if (!one_of(",")) fail(name + " takes two values, separated by a comma");
      b = sum();
    }
    if (!at_end() && text_[at_] == ',') {
      fail(name + (b < 0 ? " takes one value" : " takes two values"));
    }
    close(opened);
    return node(function->operation, a, b, where);
  }

  void close(std::size_t opened) {
    if (one_of(")")) return;
    if (!at_end()) fail("an operator or ')' is missing before " + rest());
    at_ = opened;
    fail("this '(' is never closed");
  }

  int leaf(Operation operation, double value = 0.0) {
    tree_.nodes.push_back({operation, -1, -1, value});
    return static_cast<int>(tree_.nodes.size()) - 1;
  }

  // What has only numbers under it becomes a number, so that no later pass has to be exact about
  // it.
  int node(Operation operation, int a, int b, std::size_t where) {
    const auto& nodes = tree_.nodes;
    const auto is_number = [&](int i) {
      return i < 0 || nodes[static_cast<std::size_t>(i)].operation == Operation::number;
    };
    if (is_number(a) && is_number(b)) {
      const double x = nodes[static_cast<std::size_t>(a)].number;
      const double y = b < 0 ? 0.0 : nodes[static_cast<std::size_t>(b)].number;
      const double value = applied(operation, x, y);
      if (!std::isfinite(value)) {
        at_ = where;
        fail("the value of this part is not finite (" + shortest(value) + ")");
      }
      tree_.nodes.resize(static_cast<std::size_t>(a));  // the operands were the last nodes
      return leaf(Operation::number, value);
    }
    tree_.nodes.push_back({operation, a, b, 0.0});
    return static_cast<int>(tree_.nodes.size()) - 1;
  }

  void skip_spaces() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t' || text_[at_] == '\n')) {
      ++at_;
    }
  }
  bool at_end() {
    skip_spaces();
    return at_ >= text_.size();
  }
  std::optional<char> one_of(std::string_view wanted) {
    if (at_end() || wanted.find(text_[at_]) == std::string_view::npos) return std::nullopt;
    return text_[at_++];
  }

  std::string rest() const {
    const char c = text_[at_];
    if (c >= ' ' && c <= '~') return {'\'', c, '\''};
    return static_cast<unsigned char>(c) < 128 ? "a control character"
                                               : "a character that is not ASCII";
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(what + " (character " + std::to_string(at_ + 1) + ")");
  }

  struct Nesting {
    Parser& parser;
    explicit Nesting(Parser& p) : parser(p) {
      if (++parser.depth_ > 2 * deepest_nesting) {
        parser.fail("it is nested deeper than " + std::to_string(deepest_nesting) + " levels");
      }
    }
    ~Nesting() { --parser.depth_; }
    Nesting(const Nesting&) = delete;
    Nesting& operator=(const Nesting&) = delete;
  };

  std::string_view text_;
  const NamedNumbers& named_numbers_;
  std::vector<bool> occurs_ = std::vector<bool>(named_numbers_.size());
  std::size_t at_ = 0;
  int depth_ = 0;
  Tree tree_;
};

}  // namespace

Tree parsed(std::string_view text, const NamedNumbers& named_numbers) {
  if (trimmed(text).empty()) throw InputError("it is empty");
  require_own_names(named_numbers);
  return Parser(text, named_numbers).parse();
}

}  // namespace shoal::formations::formulas
