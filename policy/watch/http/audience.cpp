#include "policy/watch/http/audience.hpp"

#include <algorithm>

namespace earshot::watch {

std::shared_ptr<Browser> Audience::join() {
  const std::lock_guard lock(mutex_);
  std::erase_if(browsers_, [](const std::weak_ptr<Browser>& browser) { return browser.expired(); });
  if (browsers_.size() >= kMostBrowsers) return nullptr;
  auto browser = std::make_shared<Browser>();
  browsers_.push_back(browser);
  return browser;
}

std::vector<std::shared_ptr<Browser>> Audience::present() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::shared_ptr<Browser>> present;
  for (const std::weak_ptr<Browser>& one : browsers_)
    if (std::shared_ptr<Browser> browser = one.lock()) present.push_back(std::move(browser));
  return present;
}

void Audience::publish(const Frame& frame) {
  for (const auto& browser : present()) dropped_ += browser->push(frame);
}

void Audience::give(const Frame& whole) {
  for (const auto& browser : present())
    if (browser->asks()) browser->give(whole);
}

void Audience::restart() {
  for (const auto& browser : present()) browser->restart();
}

bool Audience::has_followers() const {
  return std::ranges::any_of(present(), [](const auto& browser) { return !browser->asks(); });
}

bool Audience::asks() const {
  return std::ranges::any_of(present(), [](const auto& browser) { return browser->asks(); });
}

std::size_t Audience::size() const {
  return present().size();
}

}  // namespace earshot::watch
