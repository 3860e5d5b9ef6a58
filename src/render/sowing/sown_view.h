#pragma once

#include "field/delta.h"
#include "field/field.h"
#include "field/measure/leaf_area.h"
#include "field/seeds/seeds.h"
#include "shaders/shared/patch.h"

#include <cstdint>
#include <vector>

namespace sward::render {

/// A field with seeds as the first ranks of its whole meadow: blades are as narrow as they are in
/// it, and no leaf area is missing, since the rest will be sown.
class SownView {
public:
    /// The data viewed by `stored`, which must have seeds, must outlive it.
    explicit SownView(const field::FieldView& stored);
    SownView(const SownView&) = delete;
    SownView& operator=(const SownView&) = delete;

    const field::FieldView& view() const { return view_; }

    /// field::leafAreaOf() the whole meadow: of the stored blades, over their share of all.
    field::LeafAreaGrid leafArea() const;

    /// How many blades a stored one stands for.
    double bladesPerStored() const { return 1.0 / share_; }

private:
    std::vector<shared::Patch> patches_;
    field::FieldView view_;
    double share_; ///< of the blades that is stored
};

/// A change of a field with seeds, as SownView sees the field.
class SownDelta {
public:
    /// The data viewed by `stored` must outlive it.
    SownDelta(const field::Delta& stored, float widening);

    const field::Delta& delta() const { return delta_; }

private:
    std::vector<std::vector<shared::Patch>> patches_; ///< of each cell
    field::Delta delta_;
};

/// Blades of a field's seeds [1/m²], ribbons included; estimated from its meadow.
double bladesPerArea(const field::SeedMeadow& meadow);

/// Whether a field's rest is sown: it has seeds, and stores some of their blades, but not all.
bool isSown(const field::FieldView& field);

} // namespace sward::render
