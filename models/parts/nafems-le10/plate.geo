// Quarter of an elliptic ring between half axes 2 x 1 and 3.25 x 2.75 m, 0.6 m thick, divided at
// mid-height, where its outer edge is held. Wedges.
Point(1) = {0, 0, 0};
Point(2) = {2, 0, 0};
Point(3) = {3.25, 0, 0};
Point(4) = {0, 2.75, 0};
Point(5) = {0, 1, 0};
Line(1) = {2, 3};
Ellipse(2) = {3, 1, 3, 4};
Line(3) = {4, 5};
Ellipse(4) = {5, 1, 2, 2};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Curve{1} = 9 Using Progression 1.2;
Transfinite Curve{-3} = 9 Using Progression 1.2;
Transfinite Curve{2} = 17;
Transfinite Curve{4} = 17;
Transfinite Surface{1};
lower[] = Extrude{0, 0, 0.3}{ Surface{1}; Layers{2}; Recombine; };
upper[] = Extrude{0, 0, 0.3}{ Surface{lower[0]}; Layers{3}; Recombine; };
middle[] = Boundary{ Surface{lower[3]}; };
Physical Volume("plate") = {lower[1], upper[1]};
Physical Surface("top") = {upper[0]};
Physical Surface("side on x") = {lower[2], upper[2]};
Physical Surface("side on y") = {lower[4], upper[4]};
Physical Surface("outer") = {lower[3], upper[3]};
// The edge that both outer faces share.
above[] = Boundary{ Surface{upper[3]}; };
For i In {0 : #middle[] - 1}
  For j In {0 : #above[] - 1}
    If (Abs(middle[i]) == Abs(above[j]))
      Physical Curve("middle of outer") = {Abs(middle[i])};
    EndIf
  EndFor
EndFor
