// Far from the origin single precision shows in the middles of a mesh_camera's triangles, and their normals are those of the corners as written.
#version 3.7;
global_settings { assumed_gamma 1 }
camera {
  mesh_camera { 1 0 mesh {
    #for (I, 0, 19199)
      #local P = <mod(I, 160)/80 + 1000.1, 0.75 - int(I/160)/80 + 500.7, 0>;
      triangle { P, P + <0.001, 0.01, 0>, P + <0.01, 0.002, 0.001> }
    #end
  } }
  location <0, 0, -0.01>
}
#default { finish { ambient 1 diffuse 0 } }
plane { z, 2 pigment { function { mod(abs(x*3000), 1) } } hollow }
plane { z, -2 pigment { function { mod(abs(x*3000), 1) } } hollow }
