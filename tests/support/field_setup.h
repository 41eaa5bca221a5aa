#pragma once

#include "probegi/field.h"

namespace probegi::test {

/// What a field is made of and how it is set, in one: most tests vary members of both.
struct FieldSetup : FieldDesc, FieldSettings {
    FieldSetup() = default;
    FieldSetup(const FieldDesc& desc, const FieldSettings& settings = {})  // NOLINT: a desc alone will do
        : FieldDesc(desc), FieldSettings(settings) {}

    Result<Field> make(const Context& context) const { return Field::create(context, *this, *this); }
};

/// Changes the settings of a field; they must be valid.
template <class AnyField, class Change>
void changeSettings(AnyField& field, const Change& change) {
    FieldSettings settings = field.control().settings();
    change(settings);
    field.control().setSettings(settings).value();
}

}  // namespace probegi::test
