// What the search needs beside what the theme brings. It is loaded before the theme's own script.

// Words that every page has find nothing: a question is searched for by its other words. ("can" is a bus.)
const commonWords = new Set(
  ("a an and are as at be been by do does did for from has have how i if in into is it its me my not of on or should so that the then there these this to " +
    "was were what when where which who whom why will with would you your").split(" "),
);
const QUERY = 2; // the kind of message that asks the theme's worker

function withoutCommonWords(message) {
  if (!message || message.type !== QUERY || typeof message.data !== "string") return message;
  const words = message.data.split(/\s+/).map((word) => word.replace(/[?.,;!]+$/, ""));
  const left = words.filter((word) => !commonWords.has(word.toLowerCase()));
  return { ...message, data: (left.length ? left : words).join(" ") };
}

if (location.protocol === "file:") {
  // Browsers start no worker for a page that is read from a file: there it runs in a hidden frame.
  window.Worker = class extends EventTarget {
    constructor(url) {
      super();
      this.waiting = [];
      const frame = document.createElement("iframe");
      frame.hidden = true;
      frame.srcdoc = "<!doctype html><html><body></body></html>";
      frame.addEventListener("load", () => this.begin(frame.contentWindow, new URL(url, location.href).href), { once: true });
      document.documentElement.appendChild(frame);
    }

    begin(scope, url) {
      scope.postMessage = (data) => this.dispatchEvent(new MessageEvent("message", { data }));
      scope.importScripts = (...files) => Promise.all(files.map((file) => this.load(scope, new URL(file, url).href)));
      this.load(scope, url).then(() => {
        this.scope = scope;
        for (const data of this.waiting) this.postMessage(data);
      });
    }

    load(scope, url) {
      return new Promise((done, failed) => {
        const script = scope.document.createElement("script");
        script.src = url;
        script.onload = done;
        script.onerror = failed;
        scope.document.body.appendChild(script);
      });
    }

    postMessage(data) {
      if (this.scope) this.scope.dispatchEvent(new this.scope.MessageEvent("message", { data }));
      else this.waiting.push(data);
    }
  };
}

const post = Worker.prototype.postMessage;
Worker.prototype.postMessage = function (message, ...more) {
  return post.call(this, withoutCommonWords(message), ...more);
};
