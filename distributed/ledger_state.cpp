#include "distributed/ledger_state.h"

#include <algorithm>
#include <utility>

namespace lucarne {
namespace {

using Sum = std::pair<const char*, FluxSum Ledger::*>;
using Count = std::pair<const char*, std::uint64_t Ledger::*>;

constexpr Sum kSums[] = {{"emitted", &Ledger::emitted},
                         {"absorbed", &Ledger::absorbed},
                         {"escaped", &Ledger::escaped},
                         {"cut_off", &Ledger::cutOff},
                         {"roulette", &Ledger::roulette},
                         {"shading_normal", &Ledger::shadingNormal},
                         {"expected_absorbed", &Ledger::expectedAbsorbed},
                         {"incident", &Ledger::incident}};
constexpr Count kCounts[] = {{"photons", &Ledger::photons},
                             {"rays", &Ledger::rays},
                             {"hits", &Ledger::hits},
                             {"stored_hits", &Ledger::storedHits},
                             {"cut_off_paths", &Ledger::cutOffPaths},
                             {"repeated_rays", &Ledger::repeatedRays},
                             {"clamped_shading_normals", &Ledger::clampedNormals},
                             {"stray_values", &Ledger::strayValues}};

std::string toDecimal(Int128 value) {
  std::string digits;
  const bool negative = value < 0;
  do {
    const int digit = static_cast<int>(value % 10);
    digits += static_cast<char>('0' + (negative ? -digit : digit));
    value /= 10;
  } while (value != 0);
  if (negative) digits += '-';
  std::reverse(digits.begin(), digits.end());
  return digits;
}

/// At most 34 digits, so that ten thousand of them add up in 128 bits.
Int128 fromDecimal(const JsonView& view) {
  const std::string text = view.text();
  const bool negative = text.starts_with('-');
  const std::string digits = text.substr(negative ? 1 : 0);
  const bool plain = !digits.empty() && digits.size() <= 34 &&
                     std::all_of(digits.begin(), digits.end(), [](char c) { return c >= '0' && c <= '9'; });
  if (!plain) view.refuse("must be a whole number as text");
  Int128 value = 0;
  for (const char c : digits) value = value * 10 + (c - '0');
  return negative ? -value : value;
}

}  // namespace

nlohmann::json ledgerState(const Ledger& ledger) {
  nlohmann::json state;
  for (const auto& [name, member] : kSums) {
    nlohmann::json rgb = nlohmann::json::array();
    for (const Int128 units : (ledger.*member).units) rgb.push_back(toDecimal(units));
    state[name] = std::move(rgb);
  }
  for (const auto& [name, member] : kCounts) state[name] = ledger.*member;
  state["absorption_error_squares"] = toDecimal(ledger.absorptionErrorSquares);
  return state;
}

Ledger ledgerFromState(const JsonView& state) {
  Ledger ledger;
  for (const auto& [name, member] : kSums) {
    const JsonView rgb = state.at(name);
    if (rgb.size() != 3) rgb.refuse("must have 3 elements");
    for (std::size_t c = 0; c < 3; ++c) (ledger.*member).units[c] = fromDecimal(rgb.at(c));
  }
  for (const auto& [name, member] : kCounts) ledger.*member = state.at(name).count();
  ledger.absorptionErrorSquares = fromDecimal(state.at("absorption_error_squares"));
  return ledger;
}

}  // namespace lucarne
