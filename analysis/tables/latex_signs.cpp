#include "shoal/analysis/tables/latex_signs.hpp"

#include <algorithm>
#include <map>

namespace shoal::analysis {
namespace {

const std::map<std::string_view, std::string_view>& spellings() {
  static const std::map<std::string_view, std::string_view> all{
      // Greek; capitals that look like Latin ones are these.
      {"α", "$\\alpha$"},
      {"β", "$\\beta$"},
      {"γ", "$\\gamma$"},
      {"δ", "$\\delta$"},
      {"ε", "$\\varepsilon$"},
      {"ζ", "$\\zeta$"},
      {"η", "$\\eta$"},
      {"θ", "$\\theta$"},
      {"ι", "$\\iota$"},
      {"κ", "$\\kappa$"},
      {"λ", "$\\lambda$"},
      {"μ", "$\\mu$"},
      {"ν", "$\\nu$"},
      {"ξ", "$\\xi$"},
      {"ο", "o"},
      {"π", "$\\pi$"},
      {"ρ", "$\\rho$"},
      {"σ", "$\\sigma$"},
      {"ς", "$\\varsigma$"},
      {"τ", "$\\tau$"},
      {"υ", "$\\upsilon$"},
      {"φ", "$\\varphi$"},
      {"χ", "$\\chi$"},
      {"ψ", "$\\psi$"},
      {"ω", "$\\omega$"},
      {"ϑ", "$\\vartheta$"},
      {"ϕ", "$\\phi$"},
      {"ϵ", "$\\epsilon$"},
      {"Α", "A"},
      {"Β", "B"},
      {"Γ", "$\\Gamma$"},
      {"Δ", "$\\Delta$"},
      {"Ε", "E"},
      {"Ζ", "Z"},
      {"Η", "H"},
      {"Θ", "$\\Theta$"},
      {"Ι", "I"},
      {"Κ", "K"},
      {"Λ", "$\\Lambda$"},
      {"Μ", "M"},
      {"Ν", "N"},
      {"Ξ", "$\\Xi$"},
      {"Ο", "O"},
      {"Π", "$\\Pi$"},
      {"Ρ", "P"},
      {"Σ", "$\\Sigma$"},
      {"Τ", "T"},
      {"Υ", "$\\Upsilon$"},
      {"Φ", "$\\Phi$"},
      {"Χ", "X"},
      {"Ψ", "$\\Psi$"},
      {"Ω", "$\\Omega$"},
      // Mathematics.
      {"±", "$\\pm$"},
      {"∓", "$\\mp$"},
      {"°", "$^{\\circ}$"},
      {"×", "$\\times$"},
      {"÷", "$\\div$"},
      {"·", "$\\cdot$"},
      {"⋅", "$\\cdot$"},
      {"−", "$-$"},
      {"≤", "$\\leq$"},
      {"≥", "$\\geq$"},
      {"≪", "$\\ll$"},
      {"≫", "$\\gg$"},
      {"≠", "$\\neq$"},
      {"≈", "$\\approx$"},
      {"≡", "$\\equiv$"},
      {"∼", "$\\sim$"},
      {"∝", "$\\propto$"},
      {"∞", "$\\infty$"},
      {"→", "$\\rightarrow$"},
      {"←", "$\\leftarrow$"},
      {"↔", "$\\leftrightarrow$"},
      {"↑", "$\\uparrow$"},
      {"↓", "$\\downarrow$"},
      {"⇒", "$\\Rightarrow$"},
      {"⇔", "$\\Leftrightarrow$"},
      {"∈", "$\\in$"},
      {"∉", "$\\notin$"},
      {"∅", "$\\emptyset$"},
      {"∩", "$\\cap$"},
      {"∪", "$\\cup$"},
      {"⊂", "$\\subset$"},
      {"⊆", "$\\subseteq$"},
      {"∑", "$\\sum$"},
      {"∏", "$\\prod$"},
      {"∫", "$\\int$"},
      {"√", "$\\surd$"},
      {"∂", "$\\partial$"},
      {"∇", "$\\nabla$"},
      {"∆", "$\\Delta$"},
      {"∀", "$\\forall$"},
      {"∃", "$\\exists$"},
      {"¬", "$\\neg$"},
      {"∧", "$\\wedge$"},
      {"∨", "$\\vee$"},
      {"⊥", "$\\perp$"},
      {"∥", "$\\parallel$"},
      {"∠", "$\\angle$"},
      {"′", "$'$"},
      {"″", "$''$"},
      {"ℓ", "$\\ell$"},
      {"µ", "$\\mu$"},
      {"⁰", "$^{0}$"},
      {"¹", "$^{1}$"},
      {"²", "$^{2}$"},
      {"³", "$^{3}$"},
      {"⁴", "$^{4}$"},
      {"⁵", "$^{5}$"},
      {"⁶", "$^{6}$"},
      {"⁷", "$^{7}$"},
      {"⁸", "$^{8}$"},
      {"⁹", "$^{9}$"},
      {"⁻", "$^{-}$"},
      {"⁺", "$^{+}$"},
      {"ⁿ", "$^{n}$"},
      {"₀", "$_{0}$"},
      {"₁", "$_{1}$"},
      {"₂", "$_{2}$"},
      {"₃", "$_{3}$"},
      {"₄", "$_{4}$"},
      {"₅", "$_{5}$"},
      {"₆", "$_{6}$"},
      {"₇", "$_{7}$"},
      {"₈", "$_{8}$"},
      {"₉", "$_{9}$"},
      {"½", "$\\frac{1}{2}$"},
      {"¼", "$\\frac{1}{4}$"},
      {"¾", "$\\frac{3}{4}$"},
      // Punctuation. OT1, the default, lacks some of the signs that T1 has.
      {"–", "--"},
      {"—", "---"},
      {"‘", "`"},
      {"’", "'"},
      {"“", "``"},
      {"”", "''"},
      {"„", ",,"},
      {"«", "$\\ll$"},
      {"»", "$\\gg$"},
      {"…", "\\ldots{}"},
      {"•", "$\\bullet$"},
      {"†", "\\dag{}"},
      {"‡", "\\ddag{}"},
      {"§", "\\S{}"},
      {"¶", "\\P{}"},
      {"©", "\\copyright{}"},
      {"\u00a0", "~"},
      {"\u2009", "\\,"},
      {"\u202f", "\\,"},
      {"ß", "\\ss{}"}};
  return all;
}

/// Letters of Western and Central Europe, which LaTeX puts together from letter and accent.
bool is_accented_latin(std::string_view character) {
  if (character.size() != 2) return false;
  const unsigned code = (static_cast<unsigned char>(character[0]) & 0x1fu) << 6 |
                        (static_cast<unsigned char>(character[1]) & 0x3fu);
  // Neither letters with a stroke or ogonek nor eth, thorn and eng are in the fonts of OT1.
  constexpr std::string_view lacking[]{"Ð", "ð", "Þ", "þ", "Đ", "đ", "Ħ", "ħ", "ĸ",
                                       "ŉ", "Ŋ", "ŋ", "Ŧ", "ŧ", "ſ", "Ŀ", "ŀ", "Ą",
                                       "ą", "Ę", "ę", "Į", "į", "Ų", "ų"};
  return code >= 0xc0 && code <= 0x17f &&
         std::ranges::find(lacking, character) == std::end(lacking);
}

}  // namespace

std::optional<std::string> latex_sign(std::string_view character) {
  const auto found = spellings().find(character);
  if (found == spellings().end()) return std::nullopt;
  return std::string(found->second);
}

std::vector<std::string> unknown_to_latex(std::string_view latex) {
  std::vector<std::string> unknown;
  for (std::size_t at = 0; at < latex.size();) {
    std::size_t end = at + 1;
    while (end < latex.size() && (static_cast<unsigned char>(latex[end]) & 0xc0u) == 0x80u) ++end;
    const std::string_view character = latex.substr(at, end - at);
    at = end;
    if (character.size() == 1 || is_accented_latin(character)) continue;
    if (std::ranges::find(unknown, character) == unknown.end()) unknown.emplace_back(character);
  }
  return unknown;
}

}  // namespace shoal::analysis
