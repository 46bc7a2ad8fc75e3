//! Intel Embree 4, loaded at run time: choose it to compare against the industry's reference kernel.
//!
//! Nothing is linked: the shared library is opened from a path (the Python wheel `embreex` ships one). The robust scene flag
//! is always set. Only those functions of the C interface are used that one triangle mesh needs. The build quality stays at
//! its default: in robust mode the high one builds the same tree (measured).
#![allow(unsafe_code)] // a foreign C interface

use std::ffi::{c_char, c_int, c_uint, c_void};
use std::mem::ManuallyDrop;
use std::path::Path;
use std::ptr;

use libloading::Library;

use super::{RayKernel, TriangleHit, TriangleSoup};
use crate::geometry::Ray;
use crate::{Error, Result};

// Constants of the C interface (rtcore_device.h, rtcore_common.h, rtcore_buffer.h, rtcore_scene.h).
const PROPERTY_VERSION_MAJOR: c_int = 1;
const GEOMETRY_TRIANGLE: c_int = 0;
const BUFFER_INDEX: c_int = 0;
const BUFFER_VERTEX: c_int = 1;
const FORMAT_UINT3: c_int = 0x5003;
const FORMAT_FLOAT3: c_int = 0x9003;
const SCENE_ROBUST: c_int = 1 << 2;
const NOTHING: u32 = u32::MAX;

/// `RTCRay`.
#[repr(C, align(16))]
#[derive(Clone, Copy)]
struct EmbreeRay {
    origin: [f32; 3],
    t_near: f32,
    direction: [f32; 3],
    time: f32,
    t_far: f32,
    mask: u32,
    id: u32,
    flags: u32,
}

/// `RTCRayHit`, with room for all releases: from 4.2 on a hit has one field more, which its padding holds.
#[repr(C, align(16))]
struct EmbreeRayHit {
    ray: EmbreeRay,
    normal: [f32; 3],
    u: f32,
    v: f32,
    primitive: u32,
    geometry: u32,
    instance: [u32; 5],
}

impl EmbreeRay {
    fn new(ray: &Ray) -> Self {
        Self {
            origin: ray.origin.to_array(),
            // Embree's interval is closed; the smallest positive number makes it t > 0.
            t_near: f32::from_bits(1),
            direction: ray.direction.to_array(),
            time: 0.0,
            // ... and the largest number below t_max makes it t < t_max.
            t_far: ray.t_max.next_down(),
            mask: u32::MAX,
            id: 0,
            flags: 0,
        }
    }
}

type Handle = *mut c_void;

/// The functions of the C interface.
///
/// The library stays loaded until the program ends: its worker threads may outlive the last scene, and unloading it under
/// their feet crashes.
struct Functions {
    new_device: unsafe extern "C" fn(*const c_char) -> Handle,
    device_property: unsafe extern "C" fn(Handle, c_int) -> isize,
    device_error: unsafe extern "C" fn(Handle) -> c_int,
    release_device: unsafe extern "C" fn(Handle),
    new_scene: unsafe extern "C" fn(Handle) -> Handle,
    scene_flags: unsafe extern "C" fn(Handle, c_int),
    commit_scene: unsafe extern "C" fn(Handle),
    release_scene: unsafe extern "C" fn(Handle),
    new_geometry: unsafe extern "C" fn(Handle, c_int) -> Handle,
    new_buffer: unsafe extern "C" fn(Handle, c_int, c_uint, c_int, usize, usize) -> *mut c_void,
    commit_geometry: unsafe extern "C" fn(Handle),
    attach_geometry: unsafe extern "C" fn(Handle, Handle) -> c_uint,
    release_geometry: unsafe extern "C" fn(Handle),
    intersect: unsafe extern "C" fn(Handle, *mut EmbreeRayHit, *const c_void),
    occluded: unsafe extern "C" fn(Handle, *mut EmbreeRay, *const c_void),
    _library: ManuallyDrop<Library>,
}

impl Functions {
    fn load(path: &Path) -> Result<Self> {
        let failed = |what: libloading::Error| {
            Error::Settings(format!("cannot load Embree 4 from '{}': {what}", path.display()))
        };
        // SAFETY: loading runs the library's initializers; the user names a library that is to be trusted.
        let library = unsafe { Library::new(path) }.map_err(failed)?;
        macro_rules! function {
            ($name:literal) => {
                // SAFETY: the signature is that of the C header of Embree 4; `library` outlives the pointer.
                *unsafe { library.get($name) }.map_err(failed)?
            };
        }
        Ok(Self {
            new_device: function!("rtcNewDevice"),
            device_property: function!("rtcGetDeviceProperty"),
            device_error: function!("rtcGetDeviceError"),
            release_device: function!("rtcReleaseDevice"),
            new_scene: function!("rtcNewScene"),
            scene_flags: function!("rtcSetSceneFlags"),
            commit_scene: function!("rtcCommitScene"),
            release_scene: function!("rtcReleaseScene"),
            new_geometry: function!("rtcNewGeometry"),
            new_buffer: function!("rtcSetNewGeometryBuffer"),
            commit_geometry: function!("rtcCommitGeometry"),
            attach_geometry: function!("rtcAttachGeometry"),
            release_geometry: function!("rtcReleaseGeometry"),
            intersect: function!("rtcIntersect1"),
            occluded: function!("rtcOccluded1"),
            _library: ManuallyDrop::new(library),
        })
    }
}

/// The Embree kernel.
pub struct Embree {
    scene: Handle,
    device: Handle,
    functions: Functions,
}

// SAFETY: a committed scene is only read; the C interface allows queries from any thread.
unsafe impl Send for Embree {}
// SAFETY: as above.
unsafe impl Sync for Embree {}

impl Embree {
    /// Load the library and build the tree.
    ///
    /// # Errors
    /// When the library is missing, is not Embree 4, or cannot build the tree.
    pub fn build(soup: &TriangleSoup, library: &Path) -> Result<Self> {
        let functions = Functions::load(library)?;
        // SAFETY: a null configuration means the default one.
        let device = unsafe { (functions.new_device)(ptr::null()) };
        if device.is_null() {
            return Err(Error::Settings("Embree cannot open a device on this computer".into()));
        }
        // From here on `drop` releases the device, and the scene once there is one.
        let mut kernel = Self { scene: ptr::null_mut(), device, functions };
        let f = &kernel.functions;
        // SAFETY: the device is valid.
        let major = unsafe { (f.device_property)(device, PROPERTY_VERSION_MAJOR) };
        if major != 4 {
            return Err(Error::Settings(format!(
                "'{}' is Embree {major}; version 4 is needed",
                library.display()
            )));
        }
        // SAFETY: all handles are those just made; the new buffers have the sizes that are copied into them.
        unsafe {
            let geometry = (f.new_geometry)(device, GEOMETRY_TRIANGLE);
            copy_buffer(f, geometry, BUFFER_VERTEX, FORMAT_FLOAT3, soup.positions);
            copy_buffer(f, geometry, BUFFER_INDEX, FORMAT_UINT3, soup.indices);
            (f.commit_geometry)(geometry);
            kernel.scene = (f.new_scene)(device);
            (f.scene_flags)(kernel.scene, SCENE_ROBUST);
            (f.attach_geometry)(kernel.scene, geometry);
            (f.release_geometry)(geometry);
            (f.commit_scene)(kernel.scene);
        }
        // SAFETY: the device is valid.
        match unsafe { (f.device_error)(device) } {
            0 => Ok(kernel),
            code => Err(Error::Settings(format!("Embree could not build the tree (RTCError {code})"))),
        }
    }
}

/// Copy elements into a new buffer that Embree owns (and pads for its wide loads).
///
/// # Safety
/// `geometry` must be a geometry of this library, and `format` must describe `T`.
unsafe fn copy_buffer<T: Copy>(f: &Functions, geometry: Handle, kind: c_int, format: c_int, elements: &[T]) {
    if elements.is_empty() {
        return;
    }
    // SAFETY: the buffer has room for exactly these elements; it is null when memory is exhausted, which the device reports.
    unsafe {
        let buffer = (f.new_buffer)(geometry, kind, 0, format, size_of::<T>(), elements.len());
        if !buffer.is_null() {
            ptr::copy_nonoverlapping(elements.as_ptr(), buffer.cast::<T>(), elements.len());
        }
    }
}

impl Drop for Embree {
    fn drop(&mut self) {
        // SAFETY: the handles are valid and nobody uses them any more.
        unsafe {
            if !self.scene.is_null() {
                (self.functions.release_scene)(self.scene);
            }
            (self.functions.release_device)(self.device);
        }
    }
}

impl RayKernel for Embree {
    fn name(&self) -> &'static str {
        "embree"
    }

    fn closest_each(&self, rays: &[Ray], hits: &mut [Option<TriangleHit>]) {
        for (hit, ray) in hits.iter_mut().zip(rays) {
            let mut query = EmbreeRayHit {
                ray: EmbreeRay::new(ray),
                normal: [0.0; 3],
                u: 0.0,
                v: 0.0,
                primitive: NOTHING,
                geometry: NOTHING,
                instance: [NOTHING; 5],
            };
            // SAFETY: the scene is committed; `query` has the layout of RTCRayHit.
            unsafe { (self.functions.intersect)(self.scene, &raw mut query, ptr::null()) };
            *hit = (query.geometry != NOTHING).then_some(TriangleHit {
                t: query.ray.t_far,
                u: query.u,
                v: query.v,
                triangle: query.primitive,
            });
        }
    }

    fn occluded_each(&self, rays: &[Ray], occluded: &mut [bool]) {
        for (occluded, ray) in occluded.iter_mut().zip(rays) {
            let mut query = EmbreeRay::new(ray);
            // SAFETY: the scene is committed; `query` has the layout of RTCRay.
            unsafe { (self.functions.occluded)(self.scene, &raw mut query, ptr::null()) };
            *occluded = query.t_far == f32::NEG_INFINITY;
        }
    }
}
