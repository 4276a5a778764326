// With smooth the rays of a mesh_camera follow interpolated normals.
#version 3.7;
global_settings { assumed_gamma 1 }
#declare Ball = mesh {
  #for (J, 0, 7)
    #for (I, 0, 15)
      #macro P(A, B) vrotate(vrotate(x, (B - 4)*22.5*z), -A*22.5*y) #end
      #macro Q(A, B) <A/16, B/8> #end
      #if (J > 0) smooth_triangle { P(I, J), P(I, J), P(I + 1, J), P(I + 1, J), P(I, J + 1), P(I, J + 1) uv_vectors Q(I, J), Q(I + 1, J), Q(I, J + 1) } #end
      #if (J < 7) smooth_triangle { P(I + 1, J), P(I + 1, J), P(I + 1, J + 1), P(I + 1, J + 1), P(I, J + 1), P(I, J + 1) uv_vectors Q(I + 1, J), Q(I + 1, J + 1), Q(I, J + 1) } #end
    #end
  #end
}
camera { mesh_camera { 1 3 mesh { Ball scale 0.4 rotate 20 translate <0.2, 0.1, 0.3> } smooth } location 0.001*z }
background { rgb <0.3, 0.4, 0.6> }
light_source { <3, 5, -4>, rgb 1 }
box { <-4, -1.5, 0.5>, <4, -1, 4> pigment { checker rgb <0.9, 0.8, 0.7>, rgb <0.2, 0.3, 0.5> scale 0.5 } }
sphere { <-0.4, -0.2, 1.5>, 0.6 pigment { rgb <0.8, 0.2, 0.1> } }
box { <0.3, -1, 1>, <0.9, 0.1, 2> pigment { rgb <0.2, 0.6, 0.3> } rotate 10*y }
