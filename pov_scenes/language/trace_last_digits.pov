// The last digits of what `trace` returns: a ball is black or white by the parity of the sum of its hit's, multiplied by 2^52.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <9.5, 7, -10> look_at <9.5, 7, 0> right 21 * x up 15.75 * y }
#declare Random = seed(3);
#macro V(S) (<rand(Random), rand(Random), rand(Random)> - .5) * S #end
#macro Moved(Object, Way)
  object { Object
    #switch (Way)
      #case (1) translate V(2) rotate V(360) #break
      #case (2) scale <1.2, .8, 1.1> rotate V(360) #break
      #case (3) scale 1.3 translate V(1) #break
    #end
  }
#end
#declare N = 0;
#declare I = 0;
#while (I < 300)
  #switch (mod(I, 10))
    #case (0) #declare Shape = sphere { V(1), 1.2 } #break
    #case (1) #declare Shape = cylinder { V(2), V(2), 1 } #break
    #case (2) #declare Shape = cylinder { -y, y, 1.1 open } #break
    #case (3) #declare Shape = cone { V(2), .4, V(2), 1.5 } #break
    #case (4) #declare Shape = cone { V(2), 1.4, V(2), .5 } #break
    #case (5) #declare Shape = plane { V(1), .3 } #break
    #case (6) #declare Shape = box { V(1) - 1, 1 } #break
    #case (7) #declare Shape = disc { V(1), V(1), 2.5 } #break
    #case (8) #declare Shape = triangle { <-3, -1, -2>, <3, -2, -1>, <0, 4, 2> } #break
    #case (9) #declare Shape = difference { box { -1, 1 } cylinder { -2 * y, 2 * y, .8 } } #break
  #end
  #declare Shape = Moved(Shape, mod(int(I / 10), 4))
  #declare Normal = <0, 0, 0>;
  #declare Hit = trace(Shape, V(8) - 5 * z, z + V(.3), Normal);
  #declare Last = pow(2, 52) * (abs(Hit.x) + abs(Hit.y) + abs(Normal.x));
  sphere { <mod(I, 20), int(I / 20), 0>, .45
    pigment { rgb <mod(Last, 2), mod(Last, 4) / 4, vlength(Normal)> } finish { ambient 1 diffuse 0 } }
  #declare I = I + 1;
#end
