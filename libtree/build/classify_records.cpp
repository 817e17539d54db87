#include <libtree/build/classify_records.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "libtree/build/classify_records.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace treeform::detail::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// One vector of records; no branch, which would be mispredicted.
template <class Floats>
void classify_lanes(Floats d, const partition_gates& gates, const split_record* records,
                    std::uint8_t* numbers) {
    const hn::RebindToSigned<Floats> di;
    hn::VFromD<Floats> x, y, z, id;
    hn::LoadInterleaved4(d, records->center, x, y, z, id);
    auto n = hn::Set(di, 1);
    auto caught = hn::Zero(di);
    for (unsigned round = 0; round < partition_rounds; ++round) {
        const auto axis = hn::GatherIndex(di, gates.axis, n);
        const auto key =
            hn::IfThenElse(hn::RebindMask(d, hn::Eq(axis, hn::Set(di, 0))), x,
                           hn::IfThenElse(hn::RebindMask(d, hn::Eq(axis, hn::Set(di, 1))), y, z));
        const auto right = hn::RebindMask(di, hn::Gt(key, hn::GatherIndex(d, gates.hi, n)));
        const auto left = hn::RebindMask(di, hn::Lt(key, hn::GatherIndex(d, gates.lo, n)));
        const auto caught_here = hn::AndNot(hn::VecFromMask(di, hn::Or(left, right)),
                                            hn::VecFromMask(di, hn::Eq(caught, hn::Zero(di))));
        caught = hn::Or(caught, hn::And(caught_here, n));
        n = hn::Sub(hn::Add(n, n), hn::VecFromMask(di, right));  // a mask is -1
    }
    n = hn::IfThenElse(hn::Eq(caught, hn::Zero(di)), n, caught);
    const std::size_t lanes = hn::Lanes(di);
    HWY_ALIGN std::int32_t each[hn::MaxLanes(di)];
    hn::Store(n, di, each);
    for (std::size_t i = 0; i < lanes; ++i) numbers[i] = static_cast<std::uint8_t>(each[i]);
}

void classify_all(const partition_gates& gates, const split_record* records, std::size_t count,
                  std::uint8_t* numbers) {
    const hn::ScalableTag<float> d;
    const std::size_t lanes = hn::Lanes(d);
    std::size_t i = 0;
    for (; i + lanes <= count; i += lanes) classify_lanes(d, gates, records + i, numbers + i);
    for (; i < count; ++i)
        classify_lanes(hn::CappedTag<float, 1>(), gates, records + i, numbers + i);
}

}  // namespace
}  // namespace treeform::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace treeform::detail {

HWY_EXPORT(classify_all);

void classify_records(const partition_gates& gates, const split_record* records, std::size_t count,
                      std::uint8_t* numbers) {
    HWY_DYNAMIC_DISPATCH(classify_all)(gates, records, count, numbers);
}

}  // namespace treeform::detail
#endif
