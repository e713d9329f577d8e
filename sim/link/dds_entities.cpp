#include "sim/link/dds_entities.hpp"

#include <memory>

namespace earshot::link {
namespace {

dds_entity_t checked(dds_entity_t entity, const char* what, const dds_topic_descriptor_t& type) {
  if (entity < 0) throw LinkError("simulation link: " + std::string(what) + " of " + type.m_typename + ": " + dds_strretcode(entity));
  return entity;
}

using Qos = std::unique_ptr<dds_qos_t, decltype(&dds_delete_qos)>;

Qos reliable() {
  Qos qos(dds_create_qos(), &dds_delete_qos);
  dds_qset_reliability(qos.get(), DDS_RELIABILITY_RELIABLE, DDS_SECS(1));
  dds_qset_durability(qos.get(), DDS_DURABILITY_VOLATILE);
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, 16);
  return qos;
}

/// A topic is named like its type, less what DDS does not allow in a topic's name: "earshot::sim::Tick" is topic "earshot_sim_Tick".
dds_entity_t make_topic(const Session& session, const dds_topic_descriptor_t& type) {
  std::string name = type.m_typename;
  for (std::size_t at = name.find("::"); at != std::string::npos; at = name.find("::")) name.replace(at, 2, "_");
  return checked(dds_create_topic(session.participant(), &type, name.c_str(), nullptr, nullptr), "topic", type);
}

}  // namespace

dds_entity_t make_writer(const Session& session, const dds_topic_descriptor_t& type) {
  return checked(dds_create_writer(session.participant(), make_topic(session, type), reliable().get(), nullptr), "writer", type);
}

dds_entity_t make_reader(const Session& session, const dds_topic_descriptor_t& type, dds_listener_t* listener) {
  return checked(dds_create_reader(session.participant(), make_topic(session, type), reliable().get(), listener), "reader", type);
}

void write(dds_entity_t writer, const void* sample, const char* what) {
  const dds_return_t result = dds_write(writer, sample);
  if (result != DDS_RETCODE_OK) throw LinkError("simulation link: " + std::string(what) + " cannot be sent: " + dds_strretcode(result));
}

}  // namespace earshot::link
