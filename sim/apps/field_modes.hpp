#pragma once

#include "sim/apps/field_arguments.hpp"

namespace earshot::apps {

/// Each computes, writes and says in a few lines on standard output what it did; throws what is wrong in one line.
void write_radial(const FieldArguments& arguments);
void write_fan(const FieldArguments& arguments);

}  // namespace earshot::apps
