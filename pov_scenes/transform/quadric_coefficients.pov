// A quadric under a matrix, and beside it one with the coefficients M^-T S M^-1 worked out by the scene: they look alike.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -8> look_at 0 angle 40 }
light_source { <-3, 6, -8> rgb 1 }
background { rgb <0.1, 0.2, 0.3> }
#declare Move = transform { scale <1.2, 0.7, 1> rotate <20, 30, 40> translate <0.3, 0.2, 0.1> }
#declare Back = function { transform { Move inverse } }
// The rows of M^-1, four numbers each: where it takes the origin and the axes.
#declare Origin = Back(0, 0, 0);
#declare Ax = Back(1, 0, 0) - Origin;
#declare Ay = Back(0, 1, 0) - Origin;
#declare Az = Back(0, 0, 1) - Origin;
// Of x^2 + 2 y^2 + 3 z^2 - 1.
#declare S = <1, 2, 3>;
#macro Form(P, Q) (S.x*P.x*Q.x + S.y*P.y*Q.y + S.z*P.z*Q.z) #end
#declare Looks = texture { pigment { rgb <0.9, 0.7, 0.4> } finish { phong 0.5 } }
quadric { S, 0, 0, -1 texture { Looks } transform { Move } translate -1.5*x }
quadric {
  <Form(Ax, Ax), Form(Ay, Ay), Form(Az, Az)>,
  2*<Form(Ax, Ay), Form(Ax, Az), Form(Ay, Az)>,
  2*<Form(Ax, Origin), Form(Ay, Origin), Form(Az, Origin)>,
  Form(Origin, Origin) - 1
  texture { Looks }
  translate 1.5*x
}
