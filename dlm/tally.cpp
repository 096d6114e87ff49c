#include "dlm/tally.h"

#include <map>

#include "base/error.h"
#include "dlm/needs.h"

namespace lucarne {
namespace {

/// Builds and shares member sets; most charts are flat and many have the same normal.
class MemberSets {
 public:
  MemberSets(const DirectionSet& directions, TallyLayout& layout) : directions_(directions), layout_(layout) {
    layout_.memberSets.push_back({{}, std::vector<std::uint16_t>(static_cast<std::size_t>(directions.count()), 0)});
  }
  static constexpr std::uint32_t kIrradianceOnly = 0;

  std::uint32_t of(const std::vector<Vec3f>& normals) {
    std::vector<std::uint8_t> reached(static_cast<std::size_t>(directions_.count()), 0);
    for (const Vec3f& n : normals) {
      const auto& one = reachedBy(n);
      for (std::size_t psi = 0; psi < reached.size(); ++psi) reached[psi] |= one[psi];
    }
    std::vector<std::uint16_t> members;
    for (std::size_t psi = 0; psi < reached.size(); ++psi)
      if (reached[psi]) members.push_back(static_cast<std::uint16_t>(psi));
    const auto [at, isNew] = index_.try_emplace(members, static_cast<std::uint32_t>(layout_.memberSets.size()));
    if (isNew) layout_.memberSets.push_back({members, ranks(members)});
    return at->second;
  }

 private:
  const std::vector<std::uint8_t>& reachedBy(Vec3f n) {
    auto& one = byNormal_[{n.x, n.y, n.z}];
    if (one.empty())
      for (int psi = 0; psi < directions_.count(); ++psi) one.push_back(directions_.reaches(psi, Vec3d(n)));
    return one;
  }

  std::vector<std::uint16_t> ranks(const std::vector<std::uint16_t>& members) const {
    std::vector<std::uint16_t> rank;
    for (int psi = 0; psi < directions_.count(); ++psi) {
      std::size_t best = 0;
      for (std::size_t k = 0; k < members.size(); ++k) {
        if (dot(directions_.direction(members[k]), directions_.direction(psi)) >
            dot(directions_.direction(members[best]), directions_.direction(psi)))
          best = k;
      }
      rank.push_back(static_cast<std::uint16_t>(best));
    }
    return rank;
  }

  const DirectionSet& directions_;
  TallyLayout& layout_;
  std::map<std::array<float, 3>, std::vector<std::uint8_t>> byNormal_;
  std::map<std::vector<std::uint16_t>, std::uint32_t> index_;
};

/// Distinct normals of a chart on one side, rounded to about half a degree where the chart is curved: the sets of
/// neighbouring normals differ only by cells that barely touch the horizon.
std::vector<Vec3f> normalsOf(const Scene& scene, const Chart& chart, bool back) {
  std::map<std::array<int, 3>, Vec3f> distinct;
  for (const std::uint32_t t : chart.triangles) {
    const Vec3d n = normalize(scene.scaledNormal(t)) * (back ? -1.0 : 1.0);
    constexpr double kSteps = 128;
    const std::array<int, 3> key{static_cast<int>(std::floor(n.x * kSteps + 0.5)), static_cast<int>(std::floor(n.y * kSteps + 0.5)),
                                 static_cast<int>(std::floor(n.z * kSteps + 0.5))};
    distinct.try_emplace(key, Vec3f(n));
  }
  std::vector<Vec3f> normals;
  for (const auto& [key, n] : distinct) normals.push_back(n);
  return normals;
}

}  // namespace

TallyLayout planTallies(const Scene& scene, const ChartSet& charts, const TexelLayout& layout, const DirectionSet& directions,
                        const TallyWishes& wishes) {
  TallyLayout plan;
  MemberSets sets(directions, plan);
  for (std::uint32_t c = 0; c < charts.charts.size(); ++c) {
    const Chart& chart = charts.charts[c];
    const Material& material = scene.materials[chart.material];
    const Need need = needOf(material);
    const bool directional = wishes.keepAllDirections || need == Need::directions;
    // What is inside a volume shows through its front; its back has no maps.
    const bool hasBack = material.doubleSided && !(material.transmits() && material.solid);
    plan.frontSide.push_back(kNone);
    plan.backSide.push_back(kNone);
    for (const bool back : {false, true}) {
      if (need == Need::nothing || (back && !hasBack)) continue;
      TallySide side{c, back, layout.charts[c].width, layout.charts[c].height,
                     directional ? sets.of(normalsOf(scene, chart, back)) : MemberSets::kIrradianceOnly, plan.lightEntries,
                     plan.texels, plan.momentEntries};
      (back ? plan.backSide : plan.frontSide)[c] = static_cast<std::uint32_t>(plan.sides.size());
      plan.lightEntries += side.texelCount() * plan.memberSets[side.memberSet].mapCount();
      plan.texels += side.texelCount();
      if (wishes.moments) plan.momentEntries += side.texelCount() * plan.memberSets[side.memberSet].members.size();
      plan.sides.push_back(side);
    }
  }
  return plan;
}

void Tallies::add(const Tallies& other) {
  LUCARNE_CHECK_EQ(light().size(), other.light().size());
  LUCARNE_CHECK_EQ(statistics().size(), other.statistics().size());
  LUCARNE_CHECK_EQ(moments().size(), other.moments().size());
  for (std::size_t i = 0; i < light().size(); ++i) light()[i] += other.light()[i];
  for (std::size_t i = 0; i < statistics().size(); ++i) statistics()[i] += other.statistics()[i];
  for (std::size_t i = 0; i < moments().size(); ++i) moments()[i] += other.moments()[i];
  if (other.direct_ == nullptr) return;
  LUCARNE_CHECK_EQ(direct_ != nullptr, true);
  direct_->add(*other.direct_);
}

void Tallies::clear() {
  std::fill(light().begin(), light().end(), 0);
  std::fill(statistics().begin(), statistics().end(), 0);
  std::fill(moments().begin(), moments().end(), 0);
  if (direct_ != nullptr) direct_->clear();
}

void Tallies::hashInto(Hasher& hasher) const {
  static_assert(std::endian::native == std::endian::little, "tallies are hashed as little-endian bytes");
  hasher.add(std::as_bytes(light()));
  hasher.add(std::as_bytes(statistics()));
  hasher.add(std::as_bytes(moments()));
  if (direct_ != nullptr) direct_->hashInto(hasher);
}

Hash128 Tallies::contentHash() const {
  Hasher hasher;
  hashInto(hasher);
  return hasher.finish();
}

}  // namespace lucarne
