//! Scenes from short pieces of XML through the real loader, and renders of them.
#![allow(dead_code, unreachable_pub, reason = "every test binary uses a part of it")]

#[path = "../fixture/mod.rs"]
pub mod fixture;

use evenlight_render::Result;
use evenlight_render::film::Film;
use evenlight_render::render::{Settings, render};
use evenlight_render::scene::{Scene, SceneOptions};
use fixture::Folder;

/// Small files that scenes of tests may name, with their contents.
const FILES: [(&str, &[u8]); 3] = [
    ("roof.obj", include_bytes!("../data/roof.obj")),
    ("roof.ply", include_bytes!("../data/roof.ply")),
    ("pattern.png", include_bytes!("../data/pattern.png")),
];

/// Load and build a scene with this body.
pub fn try_scene(body: &str) -> std::result::Result<Scene, String> {
    let folder = Folder::new();
    for (name, content) in FILES.iter().filter(|(name, _)| body.contains(name)) {
        folder.write(name, content);
    }
    let root = folder.load(&format!("<scene version='3.0.0'>\n{body}\n</scene>"))?;
    Scene::build(&root, &SceneOptions::default()).map_err(|error| error.to_string())
}

/// The same, where nothing can go wrong.
pub fn scene(body: &str) -> Scene {
    try_scene(body).unwrap_or_else(|error| panic!("{error} in\n{body}"))
}

/// Render all of it.
pub fn picture(scene: &Scene, settings: &Settings) -> Film {
    try_picture(scene, settings).expect("valid settings")
}

pub fn try_picture(scene: &Scene, settings: &Settings) -> Result<Film> {
    render(scene, settings, &mut |_| true)
}
