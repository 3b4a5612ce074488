//! Nothing leaves the viewer: it asks for nothing but itself, and its policy refuses what it is told to send.

use super::{FRAME, open_viewer};
use crate::browser::chromium::{self, Browser};
use crate::report::simulation::SLOT;
use crate::support::{require_program, require_viewer};
use std::io::{Read, Write};
use std::net::TcpListener;
use std::sync::{Arc, Mutex};
use std::time::Duration;

#[test]
fn the_policy_refuses_every_request_from_page_frame_and_worker() {
    let Some(mut viewer) = open_viewer() else { return };
    let part = viewer.write("slot.cls", SLOT);
    viewer.show(&[part]);
    // Until here nothing but the page itself was asked for; its worker and its module are inside of it.
    let page = format!("file://{}", viewer.page.display());
    let asked: Vec<String> = viewer.browser.requests();
    assert!(
        asked.iter().all(|url| *url == page || url.starts_with("blob:") || url == "about:srcdoc"),
        "{asked:?}"
    );
    assert_eq!(viewer.browser.complaints(), [] as [String; 0]);

    let server = TcpListener::bind("127.0.0.1:0").unwrap();
    let address = format!("http://{}/", server.local_addr().unwrap());
    let fetched = format!("fetch('{address}').then(() => 'sent', () => 'refused')");
    assert_eq!(viewer.browser.value(&fetched), "refused");
    assert_eq!(viewer.browser.value(&format!("{FRAME}.{fetched}")), "refused");
    let by_worker = format!(
        "new Promise((resolve) => {{ const script = \"{}.then((what) => postMessage(what))\";
         const worker = new Worker(URL.createObjectURL(new Blob([script])));
         worker.onmessage = ({{ data }}) => resolve(data); worker.onerror = () => resolve('refused'); }})",
        fetched.replace('"', "'")
    );
    assert_eq!(viewer.browser.value(&by_worker), "refused");
    // Other ways out: a picture, a beacon, a socket, a form, a frame, a script, an inline handler.
    let others = format!(
        "(() => {{
          new Image().src = '{address}a.png';
          try {{ navigator.sendBeacon('{address}', 'x'); }} catch {{ }}
          try {{ new WebSocket('{}'); }} catch {{ }}
          const form = Object.assign(document.createElement('form'), {{ action: '{address}', method: 'post' }});
          const frame = Object.assign(document.createElement('iframe'), {{ src: '{address}' }});
          const script = Object.assign(document.createElement('script'), {{ src: '{address}s.js' }});
          const inline = Object.assign(document.createElement('script'), {{ textContent: 'window.hurt = 1' }});
          document.body.append(form, frame, script, inline);
          form.submit();
          return true; }})()",
        address.replace("http", "ws")
    );
    assert_eq!(viewer.browser.value(&others), true);
    std::thread::sleep(Duration::from_millis(500));
    // Before its policy is asked, Chromium connects for frames and forms; what counts is that no byte comes.
    server.set_nonblocking(true).unwrap();
    while let Ok((mut stream, _)) = server.accept() {
        stream.set_nonblocking(false).unwrap();
        stream.set_read_timeout(Some(Duration::from_secs(1))).unwrap();
        let mut sent = [0; 200];
        let count = stream.read(&mut sent).unwrap_or(0);
        assert_eq!(String::from_utf8_lossy(&sent[..count]), "");
    }
    assert_eq!(viewer.browser.value("window.hurt === undefined"), true);
}

#[test]
fn from_a_server_the_page_is_the_only_thing_that_is_asked_for() {
    let Some(chromium) = require_program(&chromium::NAMES) else { return };
    let Some(page) = require_viewer() else { return };
    let page = std::fs::read(page).unwrap();
    let server = TcpListener::bind("127.0.0.1:0").unwrap();
    let address = format!("http://{}/viewer.html", server.local_addr().unwrap());
    let asked = Arc::new(Mutex::new(Vec::new()));
    let noted = Arc::clone(&asked);
    std::thread::spawn(move || {
        for stream in server.incoming() {
            let Ok(mut stream) = stream else { return };
            let mut head = [0; 4096];
            let read = stream.read(&mut head).unwrap_or(0);
            let line = String::from_utf8_lossy(&head[..read]).lines().next().unwrap_or_default().to_owned();
            if line.is_empty() {
                continue;
            }
            noted.lock().unwrap().push(line);
            let answer = format!(
                "HTTP/1.1 200 OK\r\nContent-Type: text/html\r\nContent-Length: {}\r\nConnection: close\r\n\r\n",
                page.len()
            );
            let _ = stream.write_all(answer.as_bytes()).and_then(|()| stream.write_all(&page));
        }
    });
    let mut browser = Browser::start(&chromium);
    browser.open_address(&address);
    browser.wait("!!window.clsmithViewer");
    browser.value("clsmithViewer.seconds = 0; clsmithViewer.openExample()");
    browser.wait("clsmithViewer.task === null && clsmithViewer.seconds > 0");
    assert_eq!(browser.number(&format!("{FRAME}.clsmith.programs.length")), 2.0);
    assert_eq!(*asked.lock().unwrap(), ["GET /viewer.html HTTP/1.1"]);
    assert_eq!(browser.complaints(), [] as [String; 0]);
}
