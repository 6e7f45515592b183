#include "exact/packed_point.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace holdfast::exact {
namespace {

constexpr unsigned kBits = 16;  // of a size; coordinates of doubles give some hundred limbs at most
constexpr Limb kNegative = Limb{1} << (kBits - 1), kSize = kNegative - 1;

}  // namespace

PackedPoint::PackedPoint(const SpacePoint& p) {
  const std::array<const BigInt*, 4> numbers{&p.x, &p.y, &p.z, &p.w};
  std::size_t count = 1;
  for (const BigInt* n : numbers) count += n->backend().size();
  limbs_ = std::make_unique_for_overwrite<Limb[]>(count);
  limbs_[0] = 0;
  Limb* next = limbs_.get() + 1;
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const auto& number = numbers[k]->backend();
    limbs_[0] |= (Limb{number.size()} | (number.sign() ? kNegative : 0)) << (kBits * k);
    next = std::copy_n(number.limbs(), number.size(), next);
  }
}

SpacePoint PackedPoint::point() const {
  SpacePoint p;
  const std::array<BigInt*, 4> numbers{&p.x, &p.y, &p.z, &p.w};
  const Limb* next = limbs_.get() + 1;
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const Limb head = limbs_[0] >> (kBits * k);
    const auto size = static_cast<unsigned>(head & kSize);
    auto& number = numbers[k]->backend();
    number.resize(size, size);
    std::copy_n(next, size, number.limbs());
    number.normalize();
    number.sign((head & kNegative) != 0);
    next += size;
  }
  return p;
}

}  // namespace holdfast::exact
