// SPDX-License-Identifier: Apache-2.0
#include "tests/verifier/certificates.h"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "tests/verifier/krawczyk.h"

namespace hcsp::verifier {

namespace {

using Json = nlohmann::json;

double bound(const Json& json) {
  if (json.is_number()) return json.get<double>();
  const double infinity = std::numeric_limits<double>::infinity();
  return json.get<std::string>() == "oo" ? infinity : -infinity;
}

void append(const Json& low, const Json& high, Place& box) {
  if (!low.is_array()) {
    box.emplace_back(bound(low), bound(high));
    return;
  }
  for (std::size_t i = 0; i < low.size(); ++i) append(low[i], high.at(i), box);
}

/// The components of a variable in the order of their indices.
void append(const Json& variable, Place& box) {
  if (variable.at("kind") != "array") {
    append(variable.at("lo"), variable.at("hi"), box);
    return;
  }
  for (const Json& item : variable.at("items")) append(item, box);
}

bool holds(const Relation& relation, const Precise& value) {
  switch (relation.kind) {
    case Relation::Kind::zero:
      return value.is_zero();
    case Relation::Kind::at_most_zero:
      return value.is_at_most_zero();
    case Relation::Kind::negative:
      return value.is_negative();
  }
  return false;
}

/// Whether all relations but equations hold at all of a place, seen as it is or in halves.
bool certainly_holds(const System& system, const Place& place, int halvings) {
  try {
    const Evaluation there(system.expressions, place);
    if (std::all_of(system.relations.begin(), system.relations.end(), [&](const Relation& relation) {
          return relation.kind == Relation::Kind::zero || holds(relation, there.value(relation.expression));
        }))
      return true;
  } catch (const Undefined&) {
    // perhaps in the halves
  }
  if (halvings == 0) return false;
  const auto widest = std::max_element(
      place.begin(), place.end(), [](const Precise& a, const Precise& b) { return a.width() < b.width(); });
  const double middle = widest->middle();
  for (const Precise& half : {Precise(-std::numeric_limits<double>::infinity(), middle),
                              Precise(middle, std::numeric_limits<double>::infinity())}) {
    Place part = place;
    part[static_cast<std::size_t>(widest - place.begin())] = Precise::common(*widest, half);
    if (!certainly_holds(system, part, halvings - 1)) return false;
  }
  return true;
}

bool lies_in(const Place& place, const std::vector<Precise>& domains) {
  return std::equal(place.begin(), place.end(), domains.begin(), domains.end(),
                    [](const Precise& side, const Precise& domain) { return side.lies_in(domain); });
}

bool may_share(const Place& a, const Place& b) {
  return std::equal(a.begin(), a.end(), b.begin(),
                    [](const Precise& x, const Precise& y) { return x.meets(y); });
}

/// Confirms claims one by one, and keeps the zeros of the unique ones.
class Verifier {
 public:
  explicit Verifier(const System& system)
      : system_(system), domains_(system.domains()), equations_(system.equations().size()) {}

  /// What is wrong, or nothing.
  std::string wrong_with(const Claim& claim) {
    if (claim.certificate == "none") return "";
    if (claim.box.size() != domains_.size()) return "the box has not the dimension of the model";
    if (claim.certificate == "unique") return wrong_with_unique(claim.box);
    constexpr int kMostHalvings = 12;
    if (!lies_in(claim.box, domains_)) return "the box is not within the domains";
    if (!certainly_holds(system_, claim.box, kMostHalvings)) return "an inequality is not proven in the box";
    if (claim.certificate == "inner") return equations_ == 0 ? "" : "there are equations";
    if (claim.certificate != "exists") return "an unknown certificate";
    return has_zero_for_every(system_, claim.box) ? "" : "no zero is proven for every value of parameters";
  }

 private:
  std::string wrong_with_unique(const Place& box) {
    if (equations_ != domains_.size()) return "there are not as many equations as unknowns";
    const auto zero = only_zero(system_, box);
    if (!zero) return "one zero is not proven";
    if (!lies_in(*zero, domains_)) return "the zero is not within the domains";
    if (!certainly_holds(system_, *zero, 0)) return "an inequality is not proven at the zero";
    for (const Place& other : zeros_) {
      if (may_share(*zero, other)) return "the zero may be that of another box";
    }
    zeros_.push_back(*zero);
    return "";
  }

  const System& system_;
  std::vector<Precise> domains_;
  std::size_t equations_;
  std::vector<Place> zeros_;
};

}  // namespace

std::vector<Claim> claims_of(const System& system, const std::string& json) {
  std::vector<Claim> claims;
  const Json result = Json::parse(json);
  for (const Json& solution : result.at("solutions")) {
    Claim claim{solution.at("certificate").get<std::string>(), {}};
    for (const Declaration& declaration : system.declarations)
      append(solution.at("variables").at(declaration.name), claim.box);
    claims.push_back(std::move(claim));
  }
  return claims;
}

std::vector<std::string> unconfirmed(const System& system, const std::vector<Claim>& claims) {
  std::vector<std::string> complaints;
  Verifier verifier(system);
  for (std::size_t i = 0; i < claims.size(); ++i) {
    const std::string wrong = verifier.wrong_with(claims[i]);
    if (!wrong.empty())
      complaints.push_back("box " + std::to_string(i + 1) + " (" + claims[i].certificate + "): " + wrong);
  }
  return complaints;
}

}  // namespace hcsp::verifier
