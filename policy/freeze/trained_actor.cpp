#include "policy/freeze/trained_actor.hpp"

#include "firmware/host/toml/table_reader.hpp"

namespace earshot::freeze {

void check_chain(const TrainedActor& actor) {
  if (actor.layers.empty()) throw host::BadInput("has no layers");
  for (std::size_t i = 1; i < actor.layers.size(); ++i) {
    if (actor.layers[i].inputs == actor.layers[i - 1].outputs) continue;
    throw host::BadInput("layer " + std::to_string(i + 1) + " takes " + std::to_string(actor.layers[i].inputs) +
                         " inputs, the layer before it gives " + std::to_string(actor.layers[i - 1].outputs));
  }
}

}  // namespace earshot::freeze
