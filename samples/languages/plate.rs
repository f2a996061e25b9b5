// Presses a smooth plate 1 mm deep, which answers with K times the depth: 0.4 N. knurl.rs: from rust.py.
// SPDX-License-Identifier: MIT
mod knurl;
use knurl::*;
use std::{ffi::CStr, mem::size_of, mem::zeroed, ptr::null, ptr::null_mut};

fn check(result: knurl_result) -> Result<(), String> {
    match result {
        KNURL_OK => Ok(()),
        _ => Err(unsafe { CStr::from_ptr(knurl_error_message()) }.to_string_lossy().into_owned()),
    }
}

struct Scene(*mut knurl_scene);

impl Drop for Scene {
    fn drop(&mut self) {
        unsafe { knurl_scene_destroy(self.0) };
    }
}

fn main() -> Result<(), String> {
    unsafe {
        let mut plane: knurl_plane_desc = zeroed();
        let mut material: knurl_material_desc = zeroed();
        let mut surface: knurl_surface_desc = zeroed();
        knurl_plane_desc_init(&mut plane, size_of::<knurl_plane_desc>() as u32);
        knurl_material_desc_init(&mut material, size_of::<knurl_material_desc>() as u32);
        knurl_surface_desc_init(&mut surface, size_of::<knurl_surface_desc>() as u32);
        material.stiffness = 400.0; // N/m
        surface.plane = &plane;
        surface.material = &material;

        let mut scene = Scene(null_mut());
        check(knurl_scene_create(null(), &mut scene.0))?;
        check(knurl_scene_add_surface(scene.0, &surface, null_mut()))?;
        check(knurl_scene_commit(scene.0))?;

        let mut input: knurl_tick_input = zeroed();
        let mut output: knurl_tick_output = zeroed();
        for tick in 0..1000 {
            input.position[2] = f64::max(-0.001, 0.001 - 0.00001 * f64::from(tick)); // m
            check(knurl_scene_tick(scene.0, 0, &input, &mut output))?;
        }
        let version = CStr::from_ptr(knurl_version_string()).to_string_lossy();
        println!("{:.6} N, knurl {}", output.force[2], version);
    }
    Ok(())
}
