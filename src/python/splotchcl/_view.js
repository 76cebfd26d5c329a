// The widget of a View: the page of `splotchcl view` in a frame, and what goes between it and Python.
const isHere = ['localhost', '127.0.0.1', '[::1]'].includes(location.hostname);

// Where the notebook's server forwards a port of its machine (jupyter-server-proxy).
function forwarded(address) {
  const {port, pathname} = new URL(address);
  const config = document.getElementById('jupyter-config-data');
  const base = config ? JSON.parse(config.textContent).baseUrl : '/';
  return new URL(`${base}proxy/${port}${pathname}`, location.href).href;
}

async function isThere(address) {
  try {
    return (await fetch(address, {method: 'HEAD'})).ok;
  } catch {
    return false;
  }
}

// As seen from this browser, or null.
async function reachable(address) {
  if (isHere) return address;
  const other = forwarded(address);
  return await isThere(other) ? other : null;
}

function element(name, content, settings = {}) {
  const made = Object.assign(document.createElement(name), settings);
  made.append(content);
  return made;
}

function forwardingHelp(address) {
  const {port} = new URL(address);
  return `The notebook runs on another machine: install jupyter-server-proxy beside it, or forward its port ${port} ` +
      `(ssh -L ${port}:127.0.0.1:${port} MACHINE) and open ${address}`;
}

export default {
  render({model, el}) {
    const note = element('p', 'Opening the view');
    const frame = element('iframe', '', {title: 'splotchcl view', allow: 'fullscreen; clipboard-write'});
    frame.style.cssText = 'width: 100%; height: 640px; border: 0';
    el.replaceChildren(note);
    const waiting = [];
    let pageOrigin = null;
    let isOpened = false;

    // A notebook may take out of its page what is not in sight.
    function tellPage(message) {
      if (isOpened && frame.contentWindow) frame.contentWindow.postMessage(message, pageOrigin);
      else waiting.push(message);
    }

    function greet() {
      isOpened = false;
      frame.contentWindow.postMessage({splotchcl: 'hello'}, pageOrigin);
    }

    async function show(address) {
      const url = location.protocol.startsWith('http') ? await reachable(address) : null;
      if (url === null) {
        const link = element('a', 'Open the view in a tab of its own', {href: address, target: '_blank'});
        el.replaceChildren(element('p', link), ...(isHere ? [] : [element('p', forwardingHelp(address))]));
        return;
      }
      pageOrigin = new URL(url).origin;
      frame.src = url;
      frame.onload = greet;
      el.replaceChildren(frame);
    }

    function takeFromPython(content) {
      if (content.kind === 'page') show(content.address);
      if (content.kind === 'problem') note.textContent = content.text;
      if (content.kind === 'set') tellPage({splotchcl: 'set', settings: content.settings});
    }

    function takeFromPage({source, origin, data}) {
      if (source !== frame.contentWindow || origin !== pageOrigin) return;
      if (data.splotchcl === 'opened') {
        isOpened = true;
        model.send({kind: 'opened', keys: data.keys});
        waiting.splice(0).forEach(tellPage);
      }
      if (data.splotchcl === 'scene') model.send({kind: 'scene', toml: data.toml});
    }

    model.on('msg:custom', takeFromPython);
    window.addEventListener('message', takeFromPage);
    model.send({kind: 'shown', origin: location.origin});
    return () => {
      model.off('msg:custom', takeFromPython);
      window.removeEventListener('message', takeFromPage);
    };
  },
};
